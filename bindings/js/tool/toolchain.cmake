# CMake's toolchain for the tool in WebAssembly: uses clang and the C and C++ libraries of emscripten, but not its
# scripts and its JavaScript. The libraries built by bindings/js/tool/libraries are in TSPACE_WASM_PREFIX.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(UNIX TRUE)

set(CMAKE_C_COMPILER clang-14)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_AR llvm-ar-14 CACHE FILEPATH "")
set(CMAKE_RANLIB llvm-ranlib-14 CACHE FILEPATH "")
set(CMAKE_C_COMPILER_TARGET wasm32-unknown-emscripten)
set(CMAKE_CXX_COMPILER_TARGET wasm32-unknown-emscripten)
set(CMAKE_SYSROOT /usr/share/emscripten/cache/sysroot)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TSPACE_WASM_PREFIX)

# The flags that em++ passes to clang. Node.js supports threads, exceptions and 16-byte vectors since version 16.4.
string(JOIN " " flags
    -DEMSCRIPTEN -D__EMSCRIPTEN_major__=3 -D__EMSCRIPTEN_minor__=1 -D__EMSCRIPTEN_tiny__=6 -D_LIBCPP_ABI_VERSION=2
    -Dunix -D__unix -D__unix__ -Xclang -iwithsysroot/include/compat -mllvm -disable-lsr
    -pthread -msimd128 -mnontrapping-fptoint -ffp-contract=off "-isystem ${TSPACE_WASM_PREFIX}/include")
set(CMAKE_C_FLAGS_INIT "${flags}")
# library.h declares functions that the compiler and the library lack.
set(CMAKE_CXX_FLAGS_INIT "${flags} -fwasm-exceptions -include ${CMAKE_CURRENT_LIST_DIR}/library.h")
# Packages of Debian name /usr/include as their include folder. CMake does not pass an implicit folder to the compiler,
# where it would hide emscripten's own headers.
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES "")
set(CMAKE_C_IMPLICIT_INCLUDE_DIRECTORIES /usr/include)
set(CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES /usr/include)

set(CMAKE_USER_MAKE_RULES_OVERRIDE "${CMAKE_CURRENT_LIST_DIR}/rules.cmake")
set(CMAKE_CROSSCOMPILING_EMULATOR node "${CMAKE_CURRENT_LIST_DIR}/run.mjs")
set(CMAKE_HAVE_LIBC_PTHREAD TRUE)  # otherwise FindThreads would compile a test program
set(CMAKE_FIND_ROOT_PATH "${TSPACE_WASM_PREFIX}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
