#!/bin/bash
# SPDX-License-Identifier: MIT
# C and C++ files have at most 600 lines, and comments at most 120 columns: scripts/format wraps code, but not comments.
# usage: sizes.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: sizes.sh SOURCE_FOLDER}"
mapfile -t files < <(find bench bindings/js/tool bindings/js/wasm examples fuzz include src tests tools -name '*.h' -o -name '*.hpp' -o -name '*.c' -o -name '*.cpp')
[ "${#files[@]}" -gt 500 ] || { echo "only ${#files[@]} files were found"; exit 1; }
status=0
# One word may be wider, such as a link. tspace.h is generated, and users expect one header.
LC_ALL=C.UTF-8 grep -nP '^(?=.{121,}$)\s*(//|\*|/\*).* .* |^(?=.{121,}$)[^"]*[;{}] +// ' "${files[@]}" && status=1
wc -l "${files[@]}" | awk '$1 > 600 && $2 != "total" && $2 != "include/tspace/tspace.h"' | grep . && status=1
exit $status
