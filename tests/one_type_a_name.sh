#!/bin/bash
# SPDX-License-Identifier: MIT
# No two types of the library, the tool and the tests have the same qualified name. A program with both is undefined
# (the linker keeps one constructor for both), and the compiler cannot detect it, since no file includes both.
# usage: one_type_a_name.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: one_type_a_name.sh SOURCE_FOLDER}"
if ! command -v python3 >/dev/null; then
    echo "one_type_a_name: python3 is missing" >&2
    exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# names FOLDER...: prints each qualified name that two files define, with the files.
names() {
    python3 - "$@" <<'PY'
import collections, pathlib, re, sys

OPENED = re.compile(r"\b(?:struct|class|union|enum|enum class)\s+((?:\w+::)*\w+)(?:\s+final)?(?:\s*:(?!:).*)?$")

def defined(text):
    """The qualified names of the types of a file, without those in unnamed namespaces and functions."""
    text = re.sub(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|^\s*#.*?(?<!\\)$', "", text, flags=re.S | re.M)
    scopes = []
    for head, mark in re.findall(r"([^{};]*)([{};])", text):
        if mark == "}" and scopes:
            scopes.pop()
        if mark != "{":
            continue
        head = " ".join(head.split())
        namespace = re.search(r"\bnamespace ?([\w:]*)$", head)
        opened = OPENED.search(re.sub(r"\[\[.*?\]\]|\balignas\([^)]*\) ?", "", head))
        if namespace:
            scopes.append(namespace[1] or None)
        elif opened and None not in scopes:
            if not re.search(r"\btemplate ?< ?>", head):
                yield "::".join(scopes + [opened[1]])
            scopes.append(opened[1])
        else:
            scopes.append(None)

files = collections.defaultdict(set)
for root in sys.argv[1:]:
    for path in pathlib.Path(root).rglob("*"):
        if path.suffix in (".h", ".cpp"):
            for name in defined(path.read_text(encoding="utf-8")):
                files[name].add(str(path))
if len(files) < 2:
    sys.exit("hardly a type was found")
for name, places in sorted(files.items()):
    if len(places) > 1:
        print(name, *sorted(places))
PY
}

mkdir "$folder/src"
printf 'namespace a {\nstruct Same {\n    int x = 0;\n};\nnamespace {\nstruct Own {};\n}\n}\n' >"$folder/src/one.h"
printf 'namespace a::b {\nclass Same {};\n}\nnamespace a {\nclass Same final : public b::Same { };\nnamespace {\nstruct Own {};\n}\n}\n' >"$folder/src/two.cpp"
[ "$(names "$folder/src")" = "a::Same $folder/src/one.h $folder/src/two.cpp" ] || { echo "it finds no such type: $(names "$folder/src")"; exit 1; }

twice=$(names include src tools/tspace tests)
[ -z "$twice" ] || { echo "these have one name in two files:"; echo "$twice"; exit 1; }
