# Corrects what CMake assumes wrongly for WebAssembly: programs here are never position-independent, and wasm-ld links
# them. They import their memory, which threads share, and functions of bindings/js/bin/system.js.
set(CMAKE_C_COMPILE_OPTIONS_PIC "")
set(CMAKE_CXX_COMPILE_OPTIONS_PIC "")
set(CMAKE_C_COMPILE_OPTIONS_PIE "")
set(CMAKE_CXX_COMPILE_OPTIONS_PIE "")
string(JOIN " " link
    wasm-ld-14 --no-entry --gc-sections --strip-all --stack-first -z stack-size=1048576 --import-memory --shared-memory
    --initial-memory=16777216 --max-memory=4294967296 --export-table --allow-undefined
    -mllvm -wasm-enable-eh -mllvm -exception-model=wasm
    --export=__wasm_call_ctors --export=malloc --export=raise --export=stackRestore --export=_emscripten_thread_init
    --export=_emscripten_thread_exit --export=_emscripten_thread_free_data --export=emscripten_tls_init
    -L/usr/share/emscripten/cache/sysroot/lib/wasm32-emscripten
    /usr/share/emscripten/cache/sysroot/lib/wasm32-emscripten/crtbegin.o <OBJECTS> -o <TARGET> <LINK_LIBRARIES>
    --whole-archive ${TSPACE_WASM_PREFIX}/lib/libtspace_system.a --no-whole-archive
    -lc-mt -lc++-mt-except -lc++abi-mt-except -lunwind-mt-except -ldlmalloc-mt -lcompiler_rt-wasm-sjlj-mt -lcompiler_rt-mt)
set(CMAKE_CXX_LINK_EXECUTABLE "${link}")
set(CMAKE_EXECUTABLE_SUFFIX_CXX ".wasm")
