#!/bin/bash
# SPDX-License-Identifier: MIT
# The API reference is built from the headers without a warning, and a wrong comment causes a warning.
# usage: reference.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: reference.sh SOURCE_FOLDER}"
if ! command -v doxygen >/dev/null; then
    echo "reference: doxygen is missing (Debian: doxygen)" >&2
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r include scripts "$folder"
page=$("$folder/scripts/reference")
fail() {
    echo "reference: $1" >&2
    exit 1
}
pages=$(dirname "$page")
grep -q 'Computes the tangents of a mesh in one call' "$pages/namespacetspace.html" || fail "generateTangents has no page"
grep -q 'Computes the tangents of a mesh in one call' "$pages/tspace_8h.html" || fail "tspace_generateTangents has no page"
grep -q 'paramname.>execution</td>' "$pages/namespacetspace.html" || fail "parameters are no table"

sed -i 's|^/// mesh       positions; unit normals|/// meshes     positions; unit normals|' "$folder/include/tspace/tangents.h"
! cmp -s include/tspace/tangents.h "$folder/include/tspace/tangents.h" || fail "tangents.h has no such line any more"
! "$folder/scripts/reference" >"$folder/printed" 2>&1 || fail "a parameter that is missing is no error"
grep -q meshes "$folder/printed" || fail "it fails for another reason: $(<"$folder/printed")"
