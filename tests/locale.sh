#!/bin/bash
# SPDX-License-Identifier: MIT
# Numbers are read and written independently of the program's locale: std::to_chars and parseReal always use a decimal
# point.
# usage: locale.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: locale.sh SOURCE_FOLDER}"
asks='\b(strto(d|f|ld)|ato(f)|sto(d|f|ld)|s?scanf|setlocale|std::to_string\((double|float)) *\(|printf\(.*"[^"]*%[-+ #0-9.*]*[aefgAEFG]'
found=$(find src tools \( -name '*.cpp' -o -name '*.h' \) -print0 | xargs -0 grep -nE "$asks" | grep -v '^[^:]*:[0-9]*: *//' || true)
[ -z "$found" ] || { echo "these ask the locale: $found"; exit 1; }
echo 'std::snprintf(text, 8, "%.3f", x); strtod(text, &end)' | grep -qE "$asks" || { echo "nothing would be found"; exit 1; }
