# Kernels that are compiled once per CPU and chosen at run time (src/simd). Without x86-64 there is only the scalar one.
include_guard(GLOBAL)
include(CheckCXXSourceCompiles)

check_cxx_source_compiles("
    #if !defined(__x86_64__)
    #error
    #endif
    int main() { return 0; }" TSPACE_SIMD_X86)

# Gives each source whose name ends in a CPU's name the flags for that CPU, for targets of the current folder, or of
# the folder of the target that is named after the sources.
function(tspace_simd_flags sources)
    set(scope)
    if(ARGC GREATER 1)
        set(scope TARGET_DIRECTORY ${ARGV1})
    endif()
    set(avx512 -mavx512f -mavx512dq)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        list(APPEND avx512 -Wno-uninitialized -Wno-maybe-uninitialized)  # GCC 12 warns about its own header
    endif()
    foreach(source ${sources})
        if(source MATCHES "_avx2\\.cpp$")
            set_source_files_properties("${source}" ${scope} PROPERTIES COMPILE_OPTIONS "-mavx2")
        elseif(source MATCHES "_avx512\\.cpp$")
            set_source_files_properties("${source}" ${scope} PROPERTIES COMPILE_OPTIONS "${avx512}")
        endif()
    endforeach()
endfunction()

# tspace_simd_sources(NAME): adds NAME_scalar.cpp and, where there are others, NAME_sse2.cpp ... of this folder.
function(tspace_simd_sources name)
    set(sources "${CMAKE_CURRENT_SOURCE_DIR}/${name}_scalar.cpp")
    if(TSPACE_SIMD_X86)
        foreach(cpu sse2 avx2 avx512)
            list(APPEND sources "${CMAKE_CURRENT_SOURCE_DIR}/${name}_${cpu}.cpp")
        endforeach()
    endif()
    target_sources(tspace PRIVATE ${sources})
    tspace_simd_flags("${sources}" tspace)
endfunction()
