#!/bin/bash
# SPDX-License-Identifier: MIT
# Generated descriptions of reports are up to date with docs/schema, and scripts/schema reports differences.
# usage: schema.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: schema.sh SOURCE_FOLDER}"
if ! command -v python3 >/dev/null; then
    echo "schema: python3 is missing" >&2
    exit 77
fi
scripts/schema --check

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
    echo "schema: $1" >&2
    exit 1
}
fresh() {
    rm -rf "${folder:?}"/*
    mkdir -p "$folder"/{docs/reference,scripts,bindings/js/src,bindings/python/src/tspace}
    cp -r docs/schema "$folder/docs"
    cp docs/reference/json.md "$folder/docs/reference"
    cp scripts/schema "$folder/scripts"
    cp bindings/js/src/{generate_report,reports}.d.ts "$folder/bindings/js/src"
    cp bindings/python/src/tspace/_{generate_report,file_reports}.py "$folder/bindings/python/src/tspace"
}

# must_find FILE OLD NEW WORDS: after this change of the file, --check prints the words.
must_find() {
    fresh
    grep -qF -- "$2" "$1" || fail "there is no \"$2\" in $1"
    python3 - "$folder/$1" "$2" "$3" <<'PY'
import sys
path, old, new = sys.argv[1:]
text = open(path, encoding="utf-8").read().replace(old, new, 1)
open(path, "w", encoding="utf-8").write(text)
PY
    ! "$folder/scripts/schema" --check >"$folder/printed" 2>&1 || fail "not found: \"$3\" in $1"
    grep -qF -- "$4" "$folder/printed" || { cat "$folder/printed" && fail "\"$3\" in $1: nothing about \"$4\""; }
}
check=docs/schema/tspace.check.1.json
must_find docs/reference/json.md 'human-readable summary in one sentence' 'a sentence' '+| `files[].findings[].message` | string | human-readable summary in one sentence: the symptom'
must_find bindings/js/src/reports.d.ts 'worstDegrees: number' 'worstDegrees: string' '+  worstDegrees: number;'
must_find bindings/python/src/tspace/_file_reports.py 'worst_degrees: float' 'worst_degrees: int' '+    worst_degrees: float'
must_find $check '"remedy": {"type": "string"' '"remedy": {"type": "integer"' '+  remedy: number;'
must_find $check '"cause", "remedy", ' '"cause", ' 'Finding: "required"'
must_find $check '"description": "human-readable fix' '"description": "only where it is known: human-readable fix' 'Finding: "required"'
must_find $check '"else": {"maxProperties": 3}' '"else": {"maxProperties": 9}' 'CheckReport: "else"'
must_find $check '"additionalProperties": false' '"additionalProperties": true' 'CheckDocument is no object without other members'
must_find $check '"confidence": {"type": "number"' '"confidence": {"format": "date", "type": "number"' 'Finding.confidence: "format"'
must_find $check '"$id": "tspace.check.1.json"' '"$id": "tspace.check.2.json"' '$id is'
must_find $check '"const": "tspace.check/1"' '"const": "tspace.check/2"' 'another schema than its name says'

# Without --check it writes the files.
"$folder/scripts/schema" >/dev/null 2>&1 && fail "a wrong schema is no error"
fresh
rm "$folder"/bindings/js/src/*.d.ts
"$folder/scripts/schema"
for name in generate_report reports; do cmp "$folder/bindings/js/src/$name.d.ts" "bindings/js/src/$name.d.ts"; done
for wrong in --nonsense "--check more"; do
    # shellcheck disable=SC2086 # two words
    "$folder/scripts/schema" $wrong 2>/dev/null && fail "$wrong is no error"
done
[[ $("$folder/scripts/schema" --help) == "usage: scripts/schema"* ]]
