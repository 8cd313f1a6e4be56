#!/bin/bash
# SPDX-License-Identifier: MIT
# The wings, the folders of src/, are ordered: each includes only itself and those before it. The rooms of a wing, all
# units (a header with its source) and public headers must be free of cycles too; tsort determines an order or reports a
# cycle.
# usage: rooms.sh SOURCE_FOLDER
set -euo pipefail
cd "${1:?usage: rooms.sh SOURCE_FOLDER}/src"
wings=$(ls -d -- */ | tr -d / | sort | tr '\n' ' ')
[ "$wings" = "api commands core images maps model textures " ] || { echo "these are not the seven wings: $wings"; exit 1; }

# "FOLDER FOLDER" for each include. A room is a folder of a wing; folders below mesh/ and shared/ are separate rooms.
includes=$(grep -rE '^#include "[a-z_]+/' --include='*.h' --include='*.cpp' . |
    sed -E 's|^\./([^:]*)/[^/:]*:#include "(.*)/[^/"]*".*|\1 \2|' | grep -v ' tspace' | sort -u)
[ "$(wc -l <<<"$includes")" -gt 50 ] || { echo "only these includes were found: $includes"; exit 1; }

up=$(awk 'function height(folder) {
              if (folder ~ /^core\/mesh/) return order["mesh"]
              sub(/\/.*/, "", folder)
              return order[folder]
          }
          BEGIN { for (i = split("core mesh images maps textures model commands api", wing); i > 0; --i) order[wing[i]] = i }
          height($2) > height($1) { print $1, "includes", $2 }' <<<"$includes")
[ -z "$up" ] || { echo "these look up:"; echo "$up"; exit 1; }

up=$(awk '$1 ~ /^commands\/shared/ && $2 ~ /^commands\// && $2 !~ /^commands\/shared/ { print $1, "includes", $2 }' <<<"$includes")
[ -z "$up" ] || { echo "what commands share includes one of them:"; echo "$up"; exit 1; }

up=$(awk '$2 ~ /^textures/ && $1 !~ /^(textures|commands\/(compress_map|map_error)$)/ { print $1, "includes", $2 }' <<<"$includes")
[ -z "$up" ] || { echo "only compress_map and map_error know textures, but:"; echo "$up"; exit 1; }

awk '{ for (i = 1; i <= 2; ++i) {
           depth = $i ~ /^core\/mesh|^commands\/shared/ ? 3 : 2
           count = split($i, part, "/")
           $i = part[1]
           for (k = 2; k <= depth && k <= count; ++k) $i = $i "/" part[k]
       } } $1 != $2' <<<"$includes" | sort -u | tsort

# Units: "UNIT UNIT" for each include. Public headers keep their extension, since tspace.h and tspace.hpp are two units.
cd ..
units=$(grep -rE '^#include "[a-z_]+/' --include='*.h' --include='*.hpp' --include='*.cpp' src include |
    sed -E 's|^(src\|include)/([^:]*):#include "([^"]*)".*|\2 \3|' |
    awk '{ for (i = 1; i <= 2; ++i) if ($i !~ /^tspace\//) sub(/\.(h|cpp)$/, "", $i) } $1 != $2' | sort -u)
[ "$(wc -l <<<"$units")" -gt 1000 ] || { echo "only these includes were found: $units"; exit 1; }
tsort <<<"$units" >/dev/null
