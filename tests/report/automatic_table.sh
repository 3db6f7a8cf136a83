#!/bin/sh
# Make host/automatic_table.c, the tables of `--method auto` with a budget, from sweeps.
#
#     tests/report/automatic_table.sh SWEEP.csv... >host/automatic_table.c
#
# The rows of 16 bits of depth count, and only sizes that were asked for, not those that fill a budget. Scenes that
# `--method auto` is to be judged by should not be among them. How: automatic_table.awk.
set -eu
here=$(dirname "$0")
[ $# -gt 0 ] || { echo "usage: $0 SWEEP.csv...; expected the sweep.csv of gnomon sweep" >&2; exit 2; }
awk -f "$here/automatic_table.awk" "$@"
