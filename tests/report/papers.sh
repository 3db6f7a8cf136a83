#!/bin/sh
# Make the pictures of docs/papers.md and print their figures: one script a paper.
#
#     tests/report/papers.sh BUILD -o FOLDER
#
# BUILD is the folder of `make BUILD=... all`, with OpenImageIO. Call it from the top of the project.
set -eu

here=$(dirname "$0")
for paper in wang weiskopf sen milet; do
    "$here/papers_$paper.sh" "$@"
done
