# Compiler flags of every target of the project. Nothing is set globally.
include_guard(GLOBAL)

# Sets warnings, sanitizers and include paths. FMA contraction is off for every target: GCC would contract wherever the
# CPU has FMA, for example on every 64-bit ARM, so results would differ between CPUs, and inline functions of
# src/core/base would exist in two versions.
function(tspace_configure_target target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src")
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -ffp-contract=off)
    if(NOT CMAKE_BUILD_TYPE AND NOT is_multi_config AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )-O")
        target_compile_options(${target} PRIVATE -O2)
    endif()
    if(MINGW)
        # GCC assumes Microsoft's printf, which does not support %zu. MinGW-w64 provides its own, which does.
        target_compile_options(${target} PRIVATE -Wno-format -Wno-format-extra-args)
    endif()
    if(TSPACE_DEVELOPER)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(TSPACE_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=${TSPACE_SANITIZE} -fno-omit-frame-pointer
                                                 -fno-sanitize-recover=all)
        # GCC and Clang have no common macro for sanitizers.
        target_compile_definitions(${target} PRIVATE TSPACE_SANITIZED)
        target_link_options(${target} PUBLIC -fsanitize=${TSPACE_SANITIZE})
    endif()
endfunction()

# Declares the option TSPACE_WITH_<name>: ON if all variables after `missing` are set, for example by find_library.
# `missing` is the text of the error if the option is ON but a variable is not set.
function(tspace_optional name help missing)
    set(has_all ON)
    foreach(found ${ARGN})
        if(NOT ${found})
            set(has_all OFF)
        endif()
    endforeach()
    option(TSPACE_WITH_${name} "${help}" ${has_all})
    if(TSPACE_WITH_${name} AND NOT has_all)
        message(FATAL_ERROR "TSPACE_WITH_${name} is ON, but ${missing} not found")
    endif()
endfunction()

# Compiles up to forty files as one (unity build) if TSPACE_BATCHES is set.
function(tspace_batch_sources target)
    if(TSPACE_BATCHES)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 40)
        # Names of different files meet in a unity build, which causes these warnings; maybe-uninitialized also gives
        # false positives with sanitizers.
        target_compile_options(${target} PRIVATE -Wno-shadow
                               $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage;-Wno-maybe-uninitialized>)
    endif()
endfunction()

# Sets up unity builds of the core, one per folder: a program links a whole batch or nothing of it, and a program that
# computes tangents needs no normals. Files of src/core/frames are compiled separately, since few programs need more
# than one. Call this function after the target's sources are set.
function(tspace_batch_folders target)
    tspace_batch_sources(${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(source ${sources})
        get_filename_component(folder "${source}" DIRECTORY)
        get_filename_component(folder "${folder}" NAME)
        if(NOT folder STREQUAL "frames")
            set_property(SOURCE "${source}" PROPERTY UNITY_GROUP ${folder})
        endif()
    endforeach()
endfunction()

# The core guarantees identical bits on all systems, so relaxed floating-point arithmetic is off; errno of sqrt is never
# read. Release builds use -O2 for small programs, except for loops over meshes that are faster with -O3
# (tspace_optimize). Function sections let linkers drop unused functions (--gc-sections).
function(tspace_configure_core target)
    target_compile_options(${target} PRIVATE -fno-fast-math -fno-math-errno -fno-trapping-math -ffunction-sections
                                             $<$<CONFIG:Release>:-O2>)
    foreach(kind X86 ARM64 WASM)
        if(TSPACE_SIMD_${kind})
            target_compile_definitions(${target} PRIVATE TSPACE_SIMD_${kind})
        endif()
    endforeach()
endfunction()

# tspace_optimize(LEVEL FILE...): sets the optimization level of these core sources in release builds. The default is
# -O2.
function(tspace_optimize level)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:${level}>")
endfunction()

# tspace_sources(TARGET FOLDER... [EXCEPT name...]): adds all sources of these folders of the current wing. Names of
# system-specific files end in _posix or _windows.
function(tspace_sources target)
    cmake_parse_arguments(arg "" "" "EXCEPT" ${ARGN})
    foreach(folder ${arg_UNPARSED_ARGUMENTS})
        file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp")
        if(WIN32)
            list(FILTER sources EXCLUDE REGEX "_posix\\.cpp$")
        else()
            list(FILTER sources EXCLUDE REGEX "_windows\\.cpp$")
        endif()
        foreach(name ${arg_EXCEPT})
            list(FILTER sources EXCLUDE REGEX "/${name}\\.cpp$")
        endforeach()
        target_sources(${target} PRIVATE ${sources})
    endforeach()
endfunction()

# Sets the properties that all installed libraries share; `name` is the name after tspace::.
function(tspace_configure_library target name)
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}"
                          POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# tspace_wing(NAME LINKS target... [LEVEL -O...] [FOLDERS folder...] [EXCEPT name...]): defines the library tspace::NAME
# from the current folder, or from FOLDERS in it. It can include the public headers and the wings that it links. LEVEL:
# optimization of release builds.
function(tspace_wing name)
    cmake_parse_arguments(arg "" "LEVEL" "LINKS;FOLDERS;EXCEPT" ${ARGN})
    if(NOT arg_FOLDERS)
        set(arg_FOLDERS .)
    endif()
    add_library(tspace_${name} STATIC)
    add_library(tspace::${name} ALIAS tspace_${name})
    tspace_configure_target(tspace_${name})
    tspace_configure_library(tspace_${name} ${name})
    tspace_batch_sources(tspace_${name})
    tspace_sources(tspace_${name} ${arg_FOLDERS} EXCEPT ${arg_EXCEPT})
    target_link_libraries(tspace_${name} PUBLIC ${arg_LINKS})
    if(arg_LEVEL)
        target_compile_options(tspace_${name} PRIVATE $<$<CONFIG:Release>:${arg_LEVEL}>)
    endif()
endfunction()

# Defines a second library from the core's sources with other optimization flags, to test that the results have the same
# bits.
function(tspace_core_variant target)
    get_target_property(sources tspace SOURCES)
    add_library(${target} STATIC EXCLUDE_FROM_ALL ${sources})
    tspace_simd_flags("${sources}")
    tspace_configure_target(${target})
    tspace_configure_core(${target})
    target_compile_options(${target} PRIVATE ${ARGN})
    target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/include")
    target_link_libraries(${target} PUBLIC Threads::Threads)
    tspace_batch_folders(${target})
endfunction()
