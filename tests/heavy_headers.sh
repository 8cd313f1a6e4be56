#!/bin/bash
# SPDX-License-Identifier: MIT
# Limits the number of files that include the headers with the longest compile times: 0.2 to 0.5 s each for headers of
# the C++ library, seconds for the JSON library. Lower a limit when an include is removed.
# usage: heavy_headers.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: heavy_headers.sh SOURCE_FOLDER}"

failed=0
# limit HEADERS SOURCES NAME...: at most HEADERS headers and SOURCES source files may include one of these.
limit() {
    local most=("$1" "$2") kinds=(h cpp) names files count i
    shift 2
    names=$(IFS='|' && echo "$*")
    for i in 0 1; do
        files=$(grep -rlE "^ *#include <($names)[>/.]" --include="*.${kinds[i]}" src include tools/tspace | sort || true)
        count=$(wc -w <<<"$files")
        [ "$count" -le "${most[i]}" ] && continue
        printf '%s: %d files *.%s include it, at most %d may:\n%s\n' "$*" "$count" "${kinds[i]}" "${most[i]}" "$files"
        failed=1
    done
}

limit 0 1 nlohmann
limit 0 18 fmt
limit 0 0 regex random future
limit 0 1 iostream
limit 0 6 sstream fstream
limit 2 22 filesystem
limit 4 18 chrono thread condition_variable mutex
limit 18 100 functional
limit 15 100 map unordered_map
# Libraries that read files and cast rays: only one source file each may include their headers.
limit 0 1 draco
limit 0 1 embree4/rtcore embree3/rtcore
limit 1 0 tiny_obj_loader
limit 0 1 openexr tinyexr
limit 0 0 assimp
exit "$failed"
