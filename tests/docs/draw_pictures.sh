#!/bin/bash
# SPDX-License-Identifier: MIT
# Draws the pictures of the documentation that programs of this repository draw.
# usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER
set -euo pipefail
programs=${1:?usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER}
images=${2:?usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$programs/tspace_demo_model" "$work/bare.glb"
"$programs/tspace" generate -q "$work/bare.glb" -o "$work/crate.glb"
# The README: signs are lost, and mended.
python3 "$(dirname "$0")/lose_signs.py" "$work/crate.glb" "$work/lost.glb"
"$programs/tspace" generate -q --repair "$work/lost.glb" -o "$work/right.glb"
for sign in lost right; do
    "$programs/tspace" render -q "$work/$sign.glb" -o "$images/sign-$sign.png" --size 350 --samples 3 --view 14,14 --fov 20 --light=-0.3,0.9,0.65
done

# docs/flip-green.md: one map, read with green up and with green down.
for reading in gltf=right directx=turned; do
    "$programs/tspace" render -q "$work/crate.glb" -o "$images/green-${reading#*=}.png" --size 220 --samples 3 --view 8,8 --fov 20 \
        --light=0,1,0.6 --reading "${reading%=*}"
done
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
