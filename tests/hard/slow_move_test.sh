#!/bin/sh
# Fits and warps keep what docs/stability.md promises of a slow camera move (tests/report/stability_frames.sh), over the
# first frames of a path and small images. GNOMON: the simulator, build/gnomon unless set.
. tests/tap.sh

gnomon=${GNOMON:-build/gnomon}

FRAMES=16 SIZE=160x120 check "fits and warps err less than the uniform map, flicker little and do not break while the camera moves" \
    tests/report/stability_frames.sh "$gnomon" castle pipes
finish
