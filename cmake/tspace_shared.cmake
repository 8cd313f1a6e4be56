# Shared libraries that export only the C ABI, from the same objects as the static libraries.
include_guard(GLOBAL)

# tspace_shared_library(TARGET NAME OUTPUT_NAME STATIC_TARGET...): defines tspace::NAME, libOUTPUT_NAME.so.0, from all
# objects of these libraries.
function(tspace_shared_library target name output_name)
    set(objects "")
    foreach(library ${ARGN})
        list(APPEND objects $<TARGET_OBJECTS:${library}>)
    endforeach()
    add_library(${target} SHARED ${objects})
    add_library(tspace::${name} ALIAS ${target})
    # SOVERSION is the ABI number: it increases when existing programs could no longer run.
    set_target_properties(${target} PROPERTIES OUTPUT_NAME ${output_name} VERSION ${PROJECT_VERSION} SOVERSION 0
                          LINKER_LANGUAGE CXX EXPORT_NAME ${name} LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}"
                          LINK_DEPENDS "${PROJECT_SOURCE_DIR}/cmake/exported.map")
    target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_options(${target} PRIVATE "-Wl,--version-script=${PROJECT_SOURCE_DIR}/cmake/exported.map")
    if(TSPACE_SANITIZE)
        target_link_options(${target} PRIVATE -fsanitize=${TSPACE_SANITIZE})
    else()
        target_link_options(${target} PRIVATE -Wl,-z,defs)
    endif()
    target_link_libraries(${target} PRIVATE Threads::Threads)
    if(TSPACE_INSTALL)
        tspace_install_built(${target} ${target} EXPORT tspace_${name} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
                             NAMELINK_COMPONENT ${target}_link)
        tspace_install_export(${name} ${target}_link ${target})
    endif()
endfunction()

# tspace_link_needs(TARGET LIBRARY...): links the external dependencies of these libraries.
function(tspace_link_needs target)
    foreach(library ${ARGN})
        get_target_property(needs ${library} LINK_LIBRARIES)
        list(FILTER needs EXCLUDE REGEX "^tspace::")
        # Some static image libraries were not compiled for use in a shared library.
        foreach(image_library turbojpeg webp sharpyuv zstd z)
            list(TRANSFORM needs REPLACE "BUILD_INTERFACE:.*/lib${image_library}[.]a" "BUILD_INTERFACE:${image_library}")
        endforeach()
        target_link_libraries(${target} PRIVATE ${needs})
    endforeach()
endfunction()
