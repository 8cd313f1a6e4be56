#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs the command in docs/guides/from-mikktspace.md that compiles and links a C program, and then the program.
# usage: link_line.sh SOURCES LIBRARY COMPILER
set -euo pipefail
sources=$1 library=$2 compiler=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
line=$(grep -m 1 '^cc engine.c ' "$sources/docs/guides/from-mikktspace.md")
cp "$sources/tests/core/c_api/c_check.h" "$folder"
cp "$sources/tests/core/c_api/c_mikktspace_test.c" "$folder/engine.c"
ln -s "$library" "$folder/libtspace.a"
ln -s "$sources" "$folder/tspace"
cd "$folder"
read -ra words <<<"$line"
"$compiler" "${words[@]:1}"
./engine
