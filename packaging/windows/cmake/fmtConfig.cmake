# SPDX-License-Identifier: MIT
# Finds fmt as a header-only library.
if(NOT TARGET fmt::fmt)
    add_library(fmt::fmt INTERFACE IMPORTED)
    target_include_directories(fmt::fmt INTERFACE "${TSPACE_HEADERS}/include")
    target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
endif()
