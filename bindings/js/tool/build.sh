#!/bin/bash
# SPDX-License-Identifier: MIT
# build.sh OUT: compiles the tool, with the libraries that it uses to read files, into one WebAssembly module. The package contains
# OUT/bin, and OUT/share with completions for shells. The sources of the libraries are downloaded from Debian, in the versions that are
# installed on this machine.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
root=$(readlink -f "$here/../../..")
mkdir -p "$1"
out=$(readlink -f "$1")
launch=()
command -v ccache >/dev/null && launch=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

# Source packages, each with a binary package that is built from it.
packages=(draco:libdraco-dev meshoptimizer:libmeshoptimizer-dev libspng:libspng-dev libjpeg-turbo:libturbojpeg0-dev
          libwebp:libwebp-dev libzstd:libzstd-dev zlib:zlib1g-dev)

# fetch_sources FOLDER PACKAGE[=VERSION]...: with apt and separate package lists, so that the system's lists are not changed.
fetch_sources() {
    local folder=$1 codename
    shift
    codename=$(. /etc/os-release && echo "$VERSION_CODENAME")
    rm -rf "$folder"
    mkdir -p "$folder/apt/lists/partial"
    cat >"$folder/apt/debian.sources" <<EOT
Types: deb-src
URIs: http://deb.debian.org/debian
Suites: $codename $codename-updates
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg

Types: deb-src
URIs: http://deb.debian.org/debian-security
Suites: $codename-security
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
EOT
    local apt=(apt-get -qq -o "Dir::Etc::sourcelist=$folder/apt/debian.sources" -o Dir::Etc::sourceparts=/dev/null
        -o "Dir::State::lists=$folder/apt/lists" -o APT::Sandbox::User=root)
    "${apt[@]}" update
    (cd "$folder" && "${apt[@]}" source "$@" >apt/log 2>&1) || { cat "$folder/apt/log" >&2; return 1; }
    rm -rf "$folder/apt"
}

wanted=()
for package in "${packages[@]}"; do
    version=$(dpkg-query -W -f='${source:Version}' "${package#*:}" 2>/dev/null || true)
    wanted+=("${package%:*}${version:+=$version}")
done
if [ "$(cat "$out/sources/fetched" 2>/dev/null)" != "${wanted[*]}" ]; then
    echo "tool: fetching the sources of ${wanted[*]}"
    fetch_sources "$out/sources" "${wanted[@]}"
    echo "${wanted[*]}" >"$out/sources/fetched"
fi

cmake_configure() { # FOLDER_OF_SOURCES BUILD_FOLDER OPTION...
    cmake -G Ninja -S "$1" -B "$2" -DCMAKE_TOOLCHAIN_FILE="$here/toolchain.cmake" -DTSPACE_WASM_PREFIX="$out/prefix" \
        -DCMAKE_PREFIX_PATH="$out/prefix" -DCMAKE_BUILD_TYPE=Release "${launch[@]}" "${@:3}" >"$2.log" 2>&1 || { cat "$2.log" >&2; return 1; }
}
cmake_configure "$here/libraries" "$out/libraries" -DCMAKE_INSTALL_PREFIX="$out/prefix" -DSOURCES="$out/sources"
cmake --build "$out/libraries" >"$out/libraries.log" 2>&1 || { tail -40 "$out/libraries.log" >&2; exit 1; }
cmake --install "$out/libraries" >/dev/null
cmake_configure "$root" "$out/build" -DTSPACE_BUILD_TESTS=OFF -DTSPACE_BUILD_EXAMPLES=OFF
cmake --build "$out/build" --target tspace_tool tspace_made_pages >"$out/build.log" 2>&1 || { grep -a -A20 -m3 error: "$out/build.log" >&2; tail -5 "$out/build.log" >&2; exit 1; }

rm -rf "$out/bin"
mkdir -p "$out/bin"
cp "$root"/bindings/js/bin/*.js "$out/bin/"
wasm-opt -O2 --enable-threads --enable-simd --enable-bulk-memory --enable-sign-ext --enable-mutable-globals \
    --enable-nontrapping-float-to-int --enable-exception-handling "$out/build/bin/tspace.wasm" -o "$out/bin/tspace.wasm"
rm -rf "$out/share"
cp -r "$out/build/tools/tspace/made/share" "$out/share" # completions
# These texts must be distributed with the programs.
{
    echo "tspace.wasm contains parts of these libraries; tspace's own license is next to package.json."
    for library in "$out"/prefix/licenses/*; do
        printf '\n==== %s ====\n\n' "$(basename "$library")"
        cat "$library"
    done
    for package in nlohmann-json3-dev libfmt-dev libtinyobjloader-dev libxxhash-dev emscripten; do
        printf '\n==== %s ====\n\n' "$package"
        cat "/usr/share/doc/$package/copyright"
    done
} >"$out/bin/LICENSES.txt"
echo "tspace.wasm (the tool): $(stat -c %s "$out/bin/tspace.wasm") bytes, $(gzip -9 -c "$out/bin/tspace.wasm" | wc -c) gzipped"
