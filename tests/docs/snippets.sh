#!/bin/bash
# SPDX-License-Identifier: MIT
# Every C++ block of the documentation compiles against the public headers. A block with an #include is a file of its
# own; any other stands inside a function that has a mesh.
# usage: snippets.sh SOURCE_FOLDER COMPILER [FLAG...]
set -euo pipefail
cd "${1:?usage: snippets.sh SOURCE_FOLDER COMPILER [FLAG...]}"
compiler=${2:?usage: snippets.sh SOURCE_FOLDER COMPILER [FLAG...]}
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

find . -name '*.md' -not -path './build/*' -not -path './.git/*' -not -path '*/node_modules/*' | sort |
    xargs awk -v work="$work" '
        FNR == 1 { inside = 0; number = 0 }
        /^```cpp$/ { inside = 1; whole = 0; block = ""; begin = FNR + 1; next }
        /^```$/ && inside {
            inside = 0
            name = FILENAME
            gsub(/[^A-Za-z0-9]/, "_", name)
            file = work "/" name "_" ++number ".cpp"
            if (!whole) {
                print "#include <tspace/asset.h>\n#include <tspace/tspace.hpp>" >file
                print "void snippet(const tspace::MeshView& mesh, std::vector<tspace::Vec4>& tangents);" >file
                print "void snippet([[maybe_unused]] const tspace::MeshView& mesh," >file
                print "             [[maybe_unused]] std::vector<tspace::Vec4>& tangents) {" >file
            }
            print "#line " begin " \"" FILENAME "\"" >file
            printf "%s", block >file
            if (!whole) print "}" >file
            close(file)
        }
        inside { block = block $0 "\n" }
        inside && /^#include/ { whole = 1 }'

compiled=0
failed=0
for file in "$work"/*.cpp; do
    compiled=$((compiled + 1))
    "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wno-unused-variable -Wno-unused-but-set-variable -Werror \
        -Iinclude "$@" "$file" || failed=$((failed + 1))
done
echo "$compiled blocks, $failed do not compile"
[ $failed = 0 ]
