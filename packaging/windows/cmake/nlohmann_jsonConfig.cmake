# SPDX-License-Identifier: MIT
# Debian's says /usr/include, where the headers of this machine's own C library lie too.
if(NOT TARGET nlohmann_json::nlohmann_json)
    add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
    target_include_directories(nlohmann_json::nlohmann_json INTERFACE "${TSPACE_HEADERS}/include")
endif()
