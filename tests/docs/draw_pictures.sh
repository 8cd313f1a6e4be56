#!/bin/bash
# SPDX-License-Identifier: MIT
# Draws the images of the documentation that programs of this repository draw.
# usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER
set -euo pipefail
programs=${1:?usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER}
images=${2:?usage: draw_pictures.sh PROGRAMS_FOLDER IMAGES_FOLDER}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$programs/tspace_demo_model" "$work/bare.glb"
"$programs/tspace" generate -q "$work/bare.glb" -o "$work/crate.glb"
# README and docs/problems: lost signs, averaged mirror seams, NaN, and the model after --repair.
python3 "$(dirname "$0")/break_tangents.py" signs "$work/crate.glb" "$work/lost.glb"
python3 "$(dirname "$0")/break_tangents.py" nan "$work/crate.glb" "$work/nan.glb"
"$programs/tspace" generate -q "$work/bare.glb" -o "$work/averaged.glb" --method lengyel
"$programs/tspace" generate -q --repair "$work/lost.glb" -o "$work/right.glb"
crate() {
    "$programs/tspace" render -q "$work/$1.glb" -o "$images/$2.png" --size 350 --samples 3 --no-legend --view 14,14 --fov 20 --light=-0.3,0.9,0.65 "${@:3}"
}
crate lost sign-lost
crate right sign-right
crate averaged seam-averaged
crate nan spots-nan
crate right reading-unreal --reading unreal
# docs/problems/baked-map-misses-bolts.md: rays that are too short for the bolts, and rays of the default length.
python3 "$(dirname "$0")/bolt_models.py" "$work"
bolts() {
    "$programs/tspace" bake -q "$work/low.obj" --high "$work/high.obj" -o "$work/$1.png" --size 256 --out-mesh "$work/$1.glb" "${@:2}"
    "$programs/tspace" render -q "$work/$1.glb" -o "$images/$1.png" --size 300x180 --samples 3 --no-legend --view 20,35 --fov 17
}
if "$programs/tspace" bake --help >/dev/null 2>&1; then
    bolts bolts-missed --reach 0.05
    bolts bolts-baked
fi

# docs/guides/flip-green.md: one map, read with green up and with green down.
for reading in gltf=right directx=turned; do
    "$programs/tspace" render -q "$work/crate.glb" -o "$images/green-${reading#*=}.png" --size 220 --samples 3 --no-legend --view 8,8 --fov 20 \
        --light=0,1,0.6 --reading "${reading%=*}"
done
# Tangents of another method, so that the error is visible.
"$programs/tspace" generate -q "$work/bare.glb" -o "$work/flat.glb" --method flat
draw() { "$programs/tspace" render -q "$work/$1.glb" -o "$images/render-$2.png" --show "$2" --size 260 --view 20,15 "${@:3}"; }
draw crate lit
draw crate normals
draw crate mapped
draw crate tangents
draw crate sign
draw flat error
draw crate uv
draw lost both
"$programs/tspace" render -q "$work/crate.glb" -o "$images/render-turn.png" --show lit --turntable 4 --size 130 --no-legend --view 20,15
python3 "$(dirname "$0")/posed_pipe.py" "$work/pipe.glb"
pipe() { "$programs/tspace" render -q "$work/pipe.glb" -o "$images/render-$1.png" --show lit --size 260x200 --samples 3 --no-legend --view 25,10 "${@:2}"; }
pipe posed
pipe unposed --no-pose

# Draws the pictures of docs/concepts/normals.md: each kind of mesh with the usual and with the recommended normals.
python3 "$(dirname "$0")/normal_kinds.py" "$work"
normals() {
    "$programs/tspace" generate -q --all --method basis "$work/$1.obj" -o "$work/kind.glb" "${@:3}"
    "$programs/tspace" render -q "$work/kind.glb" -o "$images/normals-$1-$2.png" --size 200 --samples 3 --no-legend --view 30,25 --fov 20 --light=-0.6,0.7,0.5
}
normals grid usual --normals angle
normals grid right --normals best --denoise auto
normals scan usual --normals angle --crease 30
normals scan right --normals best --denoise auto --crease auto
normals bevel usual --normals angle
normals bevel right --normals best
normals cad usual --normals angle
normals cad right --normals best
normals decimated usual --normals angle
normals decimated right --normals best
normals turned usual --normals angle
normals turned right --normals angle --fix-winding
