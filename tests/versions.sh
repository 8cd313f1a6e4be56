#!/bin/bash
# SPDX-License-Identifier: MIT
# Every file that states the version has the version of CMakeLists.txt, and Blender accepts the manifest of the add-on:
# it rejects sentences of more than 64 characters, and sentences that end in punctuation.
# usage: versions.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: versions.sh SOURCE_FOLDER}"
version=$(sed -n 's/^project(tspace VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[ -n "$version" ] || { echo "CMakeLists.txt states no version"; exit 1; }
status=0
states() { # states FILE TEXT: the file contains this text
    grep -qF "$2" "$1" || { echo "$1 does not have: $2"; status=1; }
}
states CHANGELOG.md "## $version"
IFS=. read -r major minor patch <<<"$version"
states include/tspace/version.h "TSPACE_VERSION_MAJOR $major"
states include/tspace/version.h "TSPACE_VERSION_MINOR $minor"
states include/tspace/version.h "TSPACE_VERSION_PATCH $patch"
states include/tspace/version.h "TSPACE_VERSION_STRING \"$version\""
states bindings/rust/Cargo.toml "version = \"$version\""
states bindings/csharp/Tspace.csproj "<Version>$version</Version>"
states bindings/blender/tspace_addon/blender_manifest.toml "version = \"$version\""
states bindings/blender/tspace_addon/__init__.py "\"version\": (${version//./, }),"
states action.yml "tspace@v$version"
for text in "/tspace-$version.tgz" "/tspace-$version-py3-none-"; do states README.md "$text"; done

manifest=bindings/blender/tspace_addon/blender_manifest.toml
while IFS= read -r sentence; do
    [ ${#sentence} -le 64 ] || { echo "$manifest: ${#sentence} characters, more than 64: $sentence"; status=1; }
    [[ $sentence != *[[:punct:]] ]] || { echo "$manifest: ends in punctuation: $sentence"; status=1; }
done < <(sed -nE '/^tagline/s/.*"(.*)"/\1/p; /^\[permissions\]/,$s/^[a-z]+ = "(.*)"/\1/p' "$manifest")
exit $status
