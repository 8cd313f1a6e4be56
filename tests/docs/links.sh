#!/bin/bash
# SPDX-License-Identifier: MIT
# Every relative link in the documentation leads to a file, and its #part to a heading there.
# The page of a method ends with functions and the files that implement them.
# usage: links.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: links.sh SOURCE_FOLDER}"

# Markdown without its code blocks.
prose() { awk '/^ *```/ { code = !code; next } !code' "$1"; }

# Anchors that GitHub generates from headings: lower case, without punctuation, spaces replaced by dashes.
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

# In each item, every `function` must be defined in a linked file that follows it.
for page in docs/concepts/methods/*.md; do
    items=$(awk '/^## / { part = ""; inside = $0 == "## Implementation" } inside && !/^## / { part = part $0 "\n" }
                 END { printf "%s", part }' "$page" | grep '`' || true)
    [ -n "$items" ] || complain "$page" "the last section is not Implementation, with functions and files"
    while read -r item; do
        files=$(grep -oE '\]\([^) ]+\)' <<<"$item" | sed -E 's/^\]\(//; s/\)$//' || true)
        for name in $(grep -oE '`[A-Za-z0-9]+`' <<<"$item" | tr -d '`'); do
            (cd "$(dirname "$page")" && grep -qw -- "$name" ${files:-/dev/null}) || complain "$page" "no $name in $files"
        done
    done <<<"$items"
done

echo "$checked links, $broken broken"
[ $checked -gt 0 ] && [ $broken = 0 ]
