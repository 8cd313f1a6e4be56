#!/bin/bash
# SPDX-License-Identifier: MIT
# Every C++ and C block of the documentation compiles against the public headers. A block with an #include is a file of
# its own, C always; the others stand, each in a function that has a mesh, in one file.
# usage: snippets.sh SOURCE_FOLDER COMPILER [FLAG...]
set -euo pipefail
cd "${1:?usage: snippets.sh SOURCE_FOLDER COMPILER [FLAG...]}"
compiler=${2:?usage: snippets.sh SOURCE_FOLDER COMPILER [FLAG...]}
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

find . -name '*.md' -not -path './build/*' -not -path './.git/*' -not -path '*/node_modules/*' | sort |
    xargs awk -v work="$work" '
        BEGIN {
            functions = work "/functions.cpp"
            print "#include <tspace/asset.h>\n#include <tspace/tspace.hpp>\nnamespace {" >functions
        }
        FNR == 1 { inside = 0; number = 0 }
        /^```(cpp|c)$/ { inside = 1; language = substr($0, 4); whole = language == "c"; block = ""; begin = FNR + 1; next }
        /^```$/ && inside {
            inside = 0
            ++blocks
            name = FILENAME
            gsub(/[^A-Za-z0-9]/, "_", name)
            file = whole ? work "/" name "_" ++number "." language : functions
            if (!whole) {
                print "[[maybe_unused]] void snippet" blocks "([[maybe_unused]] const tspace::MeshView& mesh," >file
                print "    [[maybe_unused]] std::vector<tspace::Vec4>& tangents) {" >file
            }
            print "#line " begin " \"" FILENAME "\"" >file
            printf "%s", block >file
            if (!whole) print "}" >file
            if (whole) close(file)
        }
        inside { block = block $0 "\n" }
        inside && /^#include/ { whole = 1 }
        END { print "}" >functions; print blocks >(work "/blocks") }'

failed=0
for file in "$work"/*.cpp "$work"/*.c; do
    case "$file" in *.c) language=(-x c -std=c11) ;; *) language=(-x c++ -std=c++20) ;; esac
    "$compiler" "${language[@]}" -fsyntax-only -Wall -Wextra -Wno-unused-variable -Wno-unused-but-set-variable -Werror \
        -Iinclude "$@" "$file" || failed=$((failed + 1))
done
echo "$(<"$work/blocks") blocks, $failed of their files do not compile"

# The convention has no default: a call without one compiles, and ends with invalidOption.
without=$(tr '\n' ' ' <"$work/functions.cpp" | grep -oE '(generate|plan)Tangents\( *mesh, *\{[^;]*;' | grep -v convention || true)
[ -z "$without" ] || echo "these have no convention: $without"
[ $failed = 0 ] && [ -z "$without" ]
