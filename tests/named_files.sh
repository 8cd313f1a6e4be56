#!/bin/bash
# SPDX-License-Identifier: MIT
# Source files that comments mention exist, so that no comment mentions a renamed or removed file.
# usage: named_files.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: named_files.sh SOURCE_FOLDER}"
named=$(grep -rhoE '//.*' --include='*.h' --include='*.cpp' src include tools tests bench |
    grep -oE '\b[a-z][a-z0-9_]{2,}\.(h|cpp)\b' | sort -u)
[ "$(wc -l <<<"$named")" -gt 50 ] || { echo "only these names were found: $named"; exit 1; }
missing=$(comm -23 <(echo "$named") <(find src include tools tests bench examples -name '*.h' -o -name '*.cpp' | sed 's|.*/||' | sort -u))
[ -z "$missing" ] || { echo "there are no such files: $missing"; exit 1; }
