#!/bin/bash
# SPDX-License-Identifier: MIT
# The pictures of the README are what the program draws; scripts/picture draws them anew.
# usage: picture.sh PROGRAM SOURCE_FOLDER
set -euo pipefail
program=${1:?usage: picture.sh PROGRAM SOURCE_FOLDER}
images=${2:?usage: picture.sh PROGRAM SOURCE_FOLDER}/docs/images
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$program" "$work/sign-lost.png" "$work/sign-right.png"
cmp "$work/sign-lost.png" "$images/sign-lost.png"
cmp "$work/sign-right.png" "$images/sign-right.png"
