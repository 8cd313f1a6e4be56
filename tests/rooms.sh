#!/bin/bash
# SPDX-License-Identifier: MIT
# Rooms, the folders of src/, stand in an order: each includes only those below it. tsort finds it, or a loop.
# usage: rooms.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: rooms.sh SOURCE_FOLDER}/src"
# The folders below asset/ are rooms of their own; those below the others are parts of theirs.
pairs=$(grep -rE '^#include "[a-z_]+/' --include='*.h' --include='*.cpp' . |
    sed -E 's|^\./([^:]*)/[^/:]*:#include "(.*)/[^/"]*".*|\1 \2|' |
    awk '{ for (i = 1; i <= 2; ++i) if ($i !~ /^asset/) sub(/\/.*/, "", $i) } $2 !~ /^tspace/ { print $1, $2 }' | sort -u)
[ "$(wc -l <<<"$pairs")" -gt 50 ] || { echo "only these includes were found: $pairs"; exit 1; }
tsort <<<"$pairs"
