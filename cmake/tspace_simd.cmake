# Kernels that are compiled once per CPU and selected at run time (src/core/simd): several for x86-64, one for 64-bit
# ARM (little-endian) and one for WebAssembly, and scalar kernels for every CPU. A test compilation detects the target
# CPU, so that cross compilers need no settings.
include_guard(GLOBAL)
include(CheckCXXSourceCompiles)

set(CMAKE_REQUIRED_QUIET ON)  # a failed check only means that the target is another CPU
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
check_cxx_source_compiles("
    #if !defined(__wasm_simd128__)
    #error
    #endif
    int main() { return 0; }" TSPACE_SIMD_WASM)
unset(CMAKE_REQUIRED_QUIET)
if(TSPACE_SIMD_X86)
    set(tspace_simd_cpus sse2 avx2 avx512)
elseif(TSPACE_SIMD_ARM64)
    set(tspace_simd_cpus neon)
elseif(TSPACE_SIMD_WASM)
    set(tspace_simd_cpus wasm)
else()
    set(tspace_simd_cpus)
endif()

# Sets the compiler flags of each source by the CPU at the end of its name, for targets of the current folder.
function(tspace_simd_flags sources)
    set(options_avx2 -mavx2)
    set(options_avx512 -mavx512f -mavx512dq)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        list(APPEND options_avx512 -Wno-uninitialized -Wno-maybe-uninitialized)  # GCC 12 warns about its own header
    endif()
    foreach(source ${sources})
        if(source MATCHES "_(scalar|sse2|avx2|avx512|neon|wasm)\\.cpp$")
            set_source_files_properties("${source}" PROPERTIES
                COMPILE_OPTIONS "${options_${CMAKE_MATCH_1}}" SKIP_UNITY_BUILD_INCLUSION ON)
        endif()
    endforeach()
endfunction()

# tspace_simd_kernel(ROOM/NAME [NOT avx512]): compiles the kernel NAME_kernel.h of a room of the core for every CPU,
# except those on which it is not faster: TSPACE_KERNEL_TABLE_NOT_AVX512.
function(tspace_simd_kernel name)
    cmake_parse_arguments(arg "" "NOT" "" ${ARGN})
    set(kernel "core/${name}_kernel.h")
    string(REGEX REPLACE "/.*" "" room "${name}")
    foreach(cpu scalar ${tspace_simd_cpus})
        if(NOT cpu STREQUAL "${arg_NOT}")
            set_property(TARGET tspace APPEND_STRING PROPERTY TSPACE_KERNELS_${room}_${cpu} "#include \"${kernel}\"\n")
        endif()
    endforeach()
endfunction()

# tspace_simd_sources(ROOM...): generates one source per room and CPU, which includes the lanes of that CPU and all
# kernels of the room. Rooms have separate sources, so that a program that computes tangents does not contain the
# kernels of normals.
function(tspace_simd_sources)
    foreach(room ${ARGN})
        foreach(cpu scalar ${tspace_simd_cpus})
            get_target_property(kernels tspace TSPACE_KERNELS_${room}_${cpu})
            set(source "${CMAKE_CURRENT_BINARY_DIR}/kernels_${room}_${cpu}.cpp")
            configure_file("${PROJECT_SOURCE_DIR}/cmake/kernels.cpp.in" "${source}" @ONLY)
            list(APPEND sources "${source}")
        endforeach()
    endforeach()
    tspace_simd_flags("${sources}")
    # Scalar kernels that tests compare with the SIMD kernels of the CPU: LIBS tspace_scalar_kernels.
    if(tspace_simd_cpus)
        set(scalar ${sources})
        list(FILTER scalar INCLUDE REGEX "_scalar\\.cpp$")
        list(REMOVE_ITEM sources ${scalar})
        add_library(tspace_scalar_kernels OBJECT EXCLUDE_FROM_ALL ${scalar})
        tspace_configure_target(tspace_scalar_kernels)
        tspace_configure_core(tspace_scalar_kernels)
        target_link_libraries(tspace_scalar_kernels PRIVATE tspace)
    else()
        add_library(tspace_scalar_kernels INTERFACE)
    endif()
    target_sources(tspace PRIVATE ${sources})
    set_property(SOURCE ${sources} APPEND PROPERTY COMPILE_OPTIONS "$<$<CONFIG:Release>:-O3>")
endfunction()
