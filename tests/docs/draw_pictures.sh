#!/bin/bash
# SPDX-License-Identifier: MIT
# Draws the pictures of the documentation that programs of this repository draw.
# usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER
set -euo pipefail
programs=${1:?usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER}
images=${2:?usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$programs/tspace_crate_picture" "$images/sign-lost.png" "$images/sign-right.png"

"$programs/tspace_demo_model" "$work/bare.glb"
"$programs/tspace" generate -q "$work/bare.glb" -o "$work/crate.glb"
# Tangents of another method, so that there is an error to see.
"$programs/tspace" generate -q "$work/bare.glb" -o "$work/flat.glb" --method flat
draw() { "$programs/tspace" render -q "$work/$1.glb" -o "$images/render-$2.png" --show "$2" --size 260 --view 20,15 "${@:3}"; }
draw crate lit
draw crate normals
draw crate mapped
draw crate tangents
draw crate sign
draw flat error
draw crate uv
