#!/bin/bash
# SPDX-License-Identifier: MIT
# All generated mirrors of the C++ headers are up to date, and scripts/api reports differences between the APIs.
# usage: api.sh SOURCE_FOLDER [PAGES]: the program tspace_pages, which prints the options of calls on files
set -euo pipefail
cd "${1:?usage: api.sh SOURCE_FOLDER [PAGES]}"
pages=(--pages "${2-}")
if ! python3 -c ''; then
    echo "api.sh: python3 is missing" >&2
    exit 77
fi
scripts/api --check "${pages[@]}"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
    echo "api.sh: $1" >&2
    exit 1
}
# finds WHAT HEADER FROM TO: edits a header so that the APIs differ, and checks the message about it.
finds() {
    rm -rf "$folder"/*
    cp -r include scripts "$folder"
    for made in src/core/c_api tests/core/c_api bindings/python/src/tspace bindings/{rust,csharp,js}/src bindings/js/wasm; do
        mkdir -p "$folder/$made" && cp -r "$made/." "$folder/$made"
    done
    sed -i "s|$3|$4|" "$folder/include/tspace/$2"
    ! cmp -s "include/tspace/$2" "$folder/include/tspace/$2" || fail "$2 does not have \"$3\""
    ! "$folder/scripts/api" --check --pages "" >"$folder/printed" 2>&1 || fail "not found: $2 with \"$4\""
    grep -qF -- "$1" "$folder/printed" || fail "$2 with \"$4\" is found, but not for \"$1\": $(<"$folder/printed")"
}
finds "+/* Method of estimating tangents." tangents.h "Method of computing tangents" "Method of estimating tangents"
finds "+/* Method of computing tangents." tspace.h "Method of computing tangents" "Method of estimating tangents"
finds "methodTitle has no twin in C" tangents.h "^const char\* methodName(.*" "&\nconst char* methodTitle(Method method);"
finds "tspace_methodTitle has no twin in C++" tspace.h "^const char\* tspace_methodName(.*" "&\nconst char* tspace_methodTitle(tspace_Method method) TSPACE_NOEXCEPT;"
finds "+    options->refine = 3" tangents.h "refine = 1" "refine = 3"
finds "tspace_SanitizeOptions has defaults, and tspace.h has no function that sets them" tangents.h "orthogonalize_all = false" "orthogonalize_all = true"
finds "+    TSPACE_METHOD_BETTER = 9" tangents.h "^    best = 8," "&\n    better = 9,"
finds '+    "better": 9,' tangents.h "^    best = 8," "&\n    better = 9,"
finds "+    uint64_t seam_count;" tangents.h "^    std::uint64_t group_count = 0;" "    std::uint64_t seam_count = 0;\n&"
finds "+    made.seam_count = from.seam_count;" tangents.h "^    std::uint64_t group_count = 0;" "    std::uint64_t seam_count = 0;\n&"
finds "TSPACE_METHOD_FAST" tangents.h "fast = 7" "fast = 9"
finds "what is \"kLimit\" in C?" mesh.h "sizes within kMaxCorners" "sizes within kLimit"
finds "has no parameter \"meshes\"" tangents.h "^/// mesh       positions" "/// meshes     positions"
