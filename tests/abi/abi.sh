#!/bin/bash
# SPDX-License-Identifier: MIT
# Compares the ABI of a shared library with a recorded one: functions, their parameters, structs. Old programs survive a new
# function, and a field at the end of a sized struct: record it anew, so that it is compared from then on.
# usage: abi.sh HEADERS LIBRARY DUMP [--record]
set -euo pipefail
headers=$1 library=$2 dump=$3
if ! command -v abidiff >/dev/null; then
    echo "abi: abidiff is not there (Debian: abigail-tools)" >&2
    exit 77
fi
if [ "${4:-}" = --record ]; then
    abidw --exported-interfaces-only --headers-dir "$headers" --drop-private-types --no-show-locs --no-corpus-path \
        --no-comp-dir-path --no-elf-needed --no-parameter-names --out-file "$dump" "$library"
    # Where the sources lay is no part of it.
    sed -i "s#path='[^']*/src/#path='src/#" "$dump"
    exit
fi
# By headers abidiff would take all types of the dump for private ones, and see no change.
abidiff --exported-interfaces-only "$dump" "$library" && exit
echo "abi: where the change keeps old programs running, record it: tests/abi/abi.sh $* --record" >&2
exit 1
