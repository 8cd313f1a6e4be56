#!/bin/bash
# SPDX-License-Identifier: MIT
# Every relative link in the documentation leads to a file, and its #part to a heading there.
# usage: links.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: links.sh SOURCE_FOLDER}"

# Markdown without its code blocks.
prose() { awk '/^ *```/ { code = !code; next } !code' "$1"; }

# The anchors that GitHub makes of headings: lower case, punctuation dropped, each space a dash.
anchors() {
    prose "$1" | sed -nE 's/^#+ +//p' | tr '[:upper:]' '[:lower:]' | sed -E 's/[^a-z0-9 _-]//g; s/ /-/g'
}

broken=0
complain() {
    echo "$1: $2"
    broken=$((broken + 1))
}

checked=0
while read -r page; do
    while read -r link; do
        case "$link" in *://* | mailto:*) continue ;; esac
        checked=$((checked + 1))
        target=$page
        [ -z "${link%%#*}" ] || target=$(dirname "$page")/${link%%#*}
        if [ ! -e "$target" ]; then
            complain "$page" "no such file: $link"
        elif [[ $link == *#* ]] && ! grep -qxF -- "${link#*#}" <<<"$(anchors "$target")"; then
            complain "$page" "no such heading: $link"
        fi
    done < <(prose "$page" | grep -oE '\]\([^) ]+\)' | sed -E 's/^\]\(//; s/\)$//')
done < <(find . \( -name '*.md' -o -path ./llms.txt \) -not -path './build/*' -not -path './.git/*' -not -path '*/node_modules/*' | sort)

echo "$checked links, $broken broken"
[ $checked -gt 0 ] && [ $broken = 0 ]
