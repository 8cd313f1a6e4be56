#!/bin/bash
# SPDX-License-Identifier: MIT
# Compares the ABI of a shared library with a recorded one: functions, their parameters, structs. Old programs remain
# compatible with a new function, or a new field at the end of a sized struct: record it with --record, so that later
# changes are compared with it.
# usage: abi.sh HEADERS LIBRARY DUMP [--record]
set -euo pipefail
headers=$1 library=$2 dump=$3
if ! command -v abidiff >/dev/null; then
    echo "abi: abidiff is missing (Debian: abigail-tools)" >&2
    exit 77
fi
if [ "${4:-}" = --record ]; then
    abidw --exported-interfaces-only --headers-dir "$headers" --drop-private-types --no-show-locs --no-corpus-path \
        --no-comp-dir-path --no-elf-needed --no-parameter-names --out-file "$dump" "$library"
    # The folder of the sources is not part of the ABI.
    sed -i "s#path='[^']*/src/#path='src/#" "$dump"
    exit
fi
# With header files, abidiff would classify all types of the dump as private, and detect no change.
abidiff --exported-interfaces-only "$dump" "$library" && exit
echo "abi: where the change keeps old programs running, record it: tests/abi/abi.sh $* --record" >&2
exit 1
