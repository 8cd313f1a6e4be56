#!/bin/bash
# SPDX-License-Identifier: MIT
# The images of the documentation are equal to those that the programs draw, and small; scripts/picture draws them
# again.
# usage: picture.sh PROGRAMS_FOLDER SOURCE_FOLDER
set -euo pipefail
programs=${1:?usage: picture.sh PROGRAMS_FOLDER SOURCE_FOLDER}
source=${2:?usage: picture.sh PROGRAMS_FOLDER SOURCE_FOLDER}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$source/tests/docs/draw_pictures.sh" "$programs" "$work"
for picture in "$work"/*.png; do
    cmp "$picture" "$source/docs/images/$(basename "$picture")"
    bytes=$(wc -c <"$picture")
    case $(basename "$picture") in render-*) [ "$bytes" -le 60000 ] || { echo "$picture has $bytes bytes"; exit 1; } ;; esac
done
