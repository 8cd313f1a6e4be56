# Kernels that are compiled once per CPU and chosen at run time (src/simd): several for x86-64, one for 64-bit ARM
# (little-endian), and the scalar ones for every CPU. The compiler is asked what it compiles for, so that cross compilers
# need not be told.
include_guard(GLOBAL)
include(CheckCXXSourceCompiles)

check_cxx_source_compiles("
    #if !defined(__x86_64__)
    #error
    #endif
    int main() { return 0; }" TSPACE_SIMD_X86)
check_cxx_source_compiles("
    #if !defined(__aarch64__) || !defined(__ARM_NEON) || defined(__AARCH64EB__)
    #error
    #endif
    int main() { return 0; }" TSPACE_SIMD_ARM64)
if(TSPACE_SIMD_X86)
    set(tspace_simd_cpus sse2 avx2 avx512)
elseif(TSPACE_SIMD_ARM64)
    set(tspace_simd_cpus neon)
else()
    set(tspace_simd_cpus)
endif()

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
    foreach(cpu ${tspace_simd_cpus})
        list(APPEND sources "${CMAKE_CURRENT_SOURCE_DIR}/${name}_${cpu}.cpp")
    endforeach()
    target_sources(tspace PRIVATE ${sources})
    tspace_simd_flags("${sources}" tspace)
endfunction()
