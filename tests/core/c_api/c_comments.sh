#!/bin/bash
# SPDX-License-Identifier: MIT
# The C headers say what the C++ headers say; and where they do not, scripts/c_comments finds it.
# usage: c_comments.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: c_comments.sh SOURCE_FOLDER}"
if ! python3 -c ''; then
    echo "c_comments: python3 is not there" >&2
    exit 77
fi
scripts/c_comments --check

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
    echo "c_comments: $1" >&2
    exit 1
}
# finds WHAT HEADER FROM TO: an edit that makes the APIs differ, and what is printed about it.
finds() {
    rm -rf "$folder"/*
    cp -r include scripts "$folder"
    sed -i "s|$3|$4|" "$folder/include/tspace/$2"
    ! cmp -s "include/tspace/$2" "$folder/include/tspace/$2" || fail "$2 does not have \"$3\""
    ! "$folder/scripts/c_comments" --check >"$folder/printed" 2>&1 || fail "not found: $2 with \"$4\""
    grep -qF -- "$1" "$folder/printed" || fail "$2 with \"$4\" is found, but not for \"$1\": $(<"$folder/printed")"
}
finds "+/* How tangents are estimated." tangents.h "How tangents are computed" "How tangents are estimated"
"$folder/scripts/c_comments"
"$folder/scripts/c_comments" --check || fail "what it writes is not what it asks for"
finds "+/* How tangents are computed." tspace_tangents.h "How tangents are computed" "How tangents are estimated"
finds "methodTitle has no twin in C" tangents.h "^const char\* methodName(.*" "&\nconst char* methodTitle(Method method);"
finds "tspace_methodTitle has no twin in C++" tspace_tangents.h "^const char\* tspace_methodName(.*" "&\nconst char* tspace_methodTitle(tspace_Method method) TSPACE_NOEXCEPT;"
finds "tspace_TangentOptions.refine: C has the default 1, C++ 2" tangents.h "refine = 1" "refine = 2"
finds "TSPACE_METHOD_FAST" tangents.h "fast = 7" "fast = 9"
finds "what is \"kLimit\" in C?" mesh.h "sizes within kMaxCorners" "sizes within kLimit"
finds "has no parameter \"meshes\"" tangents.h "^/// mesh       positions" "/// meshes     positions"
