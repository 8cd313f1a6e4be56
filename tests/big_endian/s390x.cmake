# SPDX-License-Identifier: MIT
# CMake's toolchain for IBM Z, a big-endian machine, with Debian's cross compiler. Of this machine, only the header-only
# libraries in TSPACE_HEADERS are found.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR s390x)
set(CMAKE_C_COMPILER s390x-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER s390x-linux-gnu-g++)
set(CMAKE_FIND_ROOT_PATH "${TSPACE_HEADERS};/usr/s390x-linux-gnu")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
    set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
# Programs are linked statically, so that the emulator needs no shared libraries.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
