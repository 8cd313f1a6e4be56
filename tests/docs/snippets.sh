#!/bin/bash
# SPDX-License-Identifier: MIT
# Every C++ and C block of the documentation compiles with the public headers. Blocks with an #include, and all C
# blocks, are compiled as separate files; the others become functions with a mesh as parameter in one program, which is
# run: no call of the library may return an error.
# usage: snippets.sh SOURCE_FOLDER COMPILER LIBRARY [FLAG...]
set -euo pipefail
usage="usage: snippets.sh SOURCE_FOLDER COMPILER LIBRARY [FLAG...]"
cd "${1:?$usage}"
compiler=${2:?$usage}
library=${3:?$usage}
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

find . -name '*.md' -not -path './build/*' -not -path './.git/*' -not -path '*/node_modules/*' | sort |
    xargs awk -v work="$work" '
        BEGIN {
            functions = work "/functions.cpp"
            print "#include \"" work "/checked.h\"\nnamespace {" >functions
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
                runs[blocks] = 1
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
        END {
            print "}\n" >functions
            print "void runSnippets(const tspace::MeshView& mesh, std::vector<tspace::Vec4>& tangents) {" >functions
            for (i = 1; i <= blocks; ++i) if (i in runs) print "snippet" i "(mesh, tangents);" >functions
            print "}" >functions
            print blocks >(work "/blocks")
        }'

# Results of calls that return a Result are checked.
{
    echo '#include <tspace/generate.h>'
    echo '#include <tspace/tspace.hpp>'
    echo 'namespace tspace {'
    echo 'void failed(const char* call, const Error& error);'
    echo 'template <class T> Result<T> checked(const char* call, Result<T> result) {'
    echo '    if (!result) failed(call, result.error());'
    echo '    return result;'
    echo '}'
    echo 'template <class T> T checked(const char*, T value) { return value; }'
    echo '}'
    echo 'using namespace tspace;'
    grep -hoE '^Result<[^;]*> [a-z][A-Za-z]*\(' include/tspace/*.h | sed 's/.* //; s/($//' | sort -u |
        sed 's/.*/#define &(...) checked("&", &(__VA_ARGS__))/'
} >"$work/checked.h"

failed=0
for file in "$work"/*.cpp "$work"/*.c; do
    case "$file" in *.c) language=(-x c -std=c11) ;; *) language=(-x c++ -std=c++20) ;; esac
    "$compiler" "${language[@]}" -fsyntax-only -Wall -Wextra -Wno-unused-variable -Wno-unused-but-set-variable -Werror \
        -Iinclude "$@" "$file" || failed=$((failed + 1))
done
echo "$(<"$work/blocks") blocks, $failed of their files do not compile"

[ $failed = 0 ] || exit 1
cat >"$work/main.cpp" <<'EOF'
#include <cstdio>
#include <tspace/tspace.hpp>
void runSnippets(const tspace::MeshView& mesh, std::vector<tspace::Vec4>& tangents);
static int failed_count = 0;
namespace tspace {
void failed(const char* call, const Error& error) {
    std::printf("%s: %s: %s\n", call, errorName(error.code), error.message.c_str());
    ++failed_count;
}
}
int main() {
    // Two triangles of their own vertices, so that there are as many tangents for corners as for vertices.
    const tspace::Vec3 positions[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const tspace::Vec2 uvs[] = {{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0}};
    const std::vector<tspace::Vec3> normals(6, {0, 0, 1});
    const std::vector<std::uint32_t> indices = {0, 1, 2, 3, 4, 5};
    std::vector<tspace::Vec4> tangents(6, {1, 0, 0, 1});
    tspace::MeshView mesh;
    mesh.positions = positions;
    mesh.normals = normals;
    mesh.uvs = uvs;
    mesh.indices = std::span<const std::uint32_t>(indices);
    runSnippets(mesh, tangents);
    return failed_count == 0 ? 0 : 1;
}
EOF
"$compiler" -std=c++20 -Iinclude "$@" -w "$work/functions.cpp" "$work/main.cpp" "$library" -pthread -o "$work/snippets"
"$work/snippets"
