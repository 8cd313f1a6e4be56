# SPDX-License-Identifier: MIT
# Debian's version adds /usr/include, which also contains the headers of this machine's C library.
if(NOT TARGET nlohmann_json::nlohmann_json)
    add_library(nlohmann_json::nlohmann_json INTERFACE IMPORTED)
    target_include_directories(nlohmann_json::nlohmann_json INTERFACE "${TSPACE_HEADERS}/include")
endif()
