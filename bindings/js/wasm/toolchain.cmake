# CMake's toolchain for the modules of the npm package: the Clang and the C++ library of emscripten, without its scripts and its
# JavaScript, because the modules need no files, threads or exceptions. Flags as em++ -Oz passes them to Clang.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_CXX_COMPILER_TARGET wasm32-unknown-emscripten)
set(CMAKE_SYSROOT /usr/share/emscripten/cache/sysroot)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
string(JOIN " " CMAKE_CXX_FLAGS_INIT
    -DEMSCRIPTEN -D__EMSCRIPTEN_major__=3 -D__EMSCRIPTEN_minor__=1 -D__EMSCRIPTEN_tiny__=6 -D_LIBCPP_ABI_VERSION=2
    -Dunix -D__unix -D__unix__ -Xclang -iwithsysroot/include/compat -fignore-exceptions -fvisibility=default -fno-threadsafe-statics)
# WebAssembly is never position-independent here, and modules are linked by wasm-ld.
set(CMAKE_CXX_COMPILE_OPTIONS_PIC "")
set(CMAKE_CXX_COMPILE_OPTIONS_PIE "")
set(CMAKE_CXX_LINK_EXECUTABLE "wasm-ld-14 <LINK_FLAGS> <OBJECTS> -o <TARGET> <LINK_LIBRARIES>")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
