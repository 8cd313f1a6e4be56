# SPDX-License-Identifier: MIT
# Compiling for IBM Z, which keeps numbers with their high byte first, by Debian's compiler. Nothing of this machine is found but
# what lies in TSPACE_HEADERS: libraries that are headers alone.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR s390x)
set(CMAKE_C_COMPILER s390x-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER s390x-linux-gnu-g++)
set(CMAKE_FIND_ROOT_PATH "${TSPACE_HEADERS};/usr/s390x-linux-gnu")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
    set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
# The emulator needs no libraries then.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
