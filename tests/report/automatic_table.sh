#!/bin/sh
# Make host/automatic_table.c, the tables of `--method auto` with a budget, from sweeps.
#
#     build/gnomon procedural all -o scenes && build/gnomon procedural all --view 31 -o scenes
#     build/gnomon sweep scenes/*.scene -o sweep --depths 16 --budgets none --maps 64,128,256,512 --methods METHODS
#     tests/report/automatic_table.sh sweep/sweep.csv >host/automatic_table.c
#
# METHODS, with commas: constant, mixed, crossing, crossing/msf+rectilinear; mixed+virtual and silhouette, uniform and with /dv, /msf,
# /rectilinear, /dv+rectilinear, /msf+rectilinear, /dv+rectilinear-distance: what the sweep offers of the tables' pairs.
# The rows of 16 bits of depth count, and only sizes that were asked for, not those that fill a budget. Scenes that
# `--method auto` is to be judged by should not be among them. How: automatic_table.awk.
set -eu
here=$(dirname "$0")
[ $# -gt 0 ] || { echo "usage: $0 SWEEP.csv...; expected the sweep.csv of gnomon sweep" >&2; exit 2; }
awk -f "$here/automatic_table.awk" "$@"
