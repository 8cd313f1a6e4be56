# Installation and packages. Component tspace_core is the core library and has no dependencies; tspace_asset exists if
# it is part of the build; tspace_tool contains the programs. Consumers use find_package(tspace [COMPONENTS core asset
# shared]) or pkg-config.
include(CMakePackageConfigHelpers)

tspace_install_built(tspace tspace_core EXPORT tspace_core ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/tspace" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT tspace_core
        FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp"
        PATTERN "bake_file.h" EXCLUDE PATTERN "check.h" EXCLUDE PATTERN "file_options.h" EXCLUDE PATTERN "generate.h" EXCLUDE PATTERN "inspect.h" EXCLUDE PATTERN "map_files.h" EXCLUDE PATTERN "maps.h" EXCLUDE PATTERN "render.h" EXCLUDE PATTERN "tspace_files.h" EXCLUDE)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/mikktspace" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT tspace_core)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/shaders" DESTINATION "${CMAKE_INSTALL_DATADIR}/tspace" COMPONENT tspace_core)
tspace_install_export(core tspace_core tspace)

if(TARGET tspace_asset)
    set(wings tspace_mesh tspace_images tspace_maps tspace_textures tspace_model tspace_commands)
    foreach(wing ${wings})
        tspace_install_built(${wing} tspace_asset EXPORT tspace_asset ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    endforeach()
    install(TARGETS tspace_asset EXPORT tspace_asset COMPONENT tspace_asset)
    tspace_install_built(tspace_files tspace_asset EXPORT tspace_files ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/tspace" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
            COMPONENT tspace_asset FILES_MATCHING PATTERN "bake_file.h" PATTERN "check.h" PATTERN "file_options.h" PATTERN "generate.h" PATTERN "inspect.h" PATTERN "map_files.h" PATTERN "maps.h" PATTERN "render.h" PATTERN "tspace_files.h")
    tspace_install_export(asset tspace_asset tspace ${wings})
    tspace_install_export(files tspace_asset tspace ${wings} tspace_files)
endif()

foreach(program tspace_tool tspace_import)
    if(TARGET ${program})
        tspace_install_built(${program} tspace_tool RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
    endif()
endforeach()

# Installs the schemas of reports, for programs that read reports.
if(TARGET tspace_tool)
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/schema" DESTINATION "${CMAKE_INSTALL_DATADIR}/tspace" COMPONENT tspace_tool)
endif()

# Installs the page that tspace view writes, if scripts/web has built it.
install(FILES "${PROJECT_SOURCE_DIR}/build/web/view.html" "${PROJECT_SOURCE_DIR}/build/web/learn.html" DESTINATION "${CMAKE_INSTALL_DATADIR}/tspace" COMPONENT tspace_tool OPTIONAL)

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/tspace" COMPONENT tspace_core)

# The library is static, so C programs must also link the C++ runtime.
set(TSPACE_PC_CXX_RUNTIME "")
foreach(runtime stdc++ c++)
    if(runtime IN_LIST CMAKE_CXX_IMPLICIT_LINK_LIBRARIES)
        set(TSPACE_PC_CXX_RUNTIME "-l${runtime}")
    endif()
endforeach()

# The reason that find_package reports for a missing component.
set(TSPACE_WITHOUT_ASSET "which had not been built")
set(TSPACE_WITHOUT_SHARED "which had not been built")
if(NOT TSPACE_BUILD_ASSET)
    set(TSPACE_WITHOUT_ASSET "since TSPACE_BUILD_ASSET was OFF")
    if(TSPACE_ASSET_NEEDED)
        string(REPLACE ";" " " needed "${TSPACE_ASSET_NEEDED}")
        set(TSPACE_WITHOUT_ASSET "since libraries were not found, as Debian packages: ${needed}")
    endif()
endif()
if(NOT TSPACE_BUILD_SHARED)
    set(TSPACE_WITHOUT_SHARED "since TSPACE_BUILD_SHARED was OFF")
endif()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/tspaceConfig.cmake.in"
                              "${PROJECT_BINARY_DIR}/package/tspaceConfig.cmake"
                              INSTALL_DESTINATION "${TSPACE_CMAKE_DIR}")
# Before 1.0 a new minor version may break callers.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/tspaceConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/package/tspaceConfig.cmake" "${PROJECT_BINARY_DIR}/package/tspaceConfigVersion.cmake"
        DESTINATION "${TSPACE_CMAKE_DIR}" COMPONENT tspace_core)

# The prefix is derived from the location of the file, so that an installed tree can be moved.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
    set(TSPACE_PC_PREFIX "${CMAKE_INSTALL_PREFIX}")
    set(TSPACE_PC_LIBDIR "${CMAKE_INSTALL_FULL_LIBDIR}")
    set(TSPACE_PC_INCLUDEDIR "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
else()
    file(RELATIVE_PATH TSPACE_PC_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
    set(TSPACE_PC_PREFIX "\${pcfiledir}/${TSPACE_PC_PREFIX}")
    set(TSPACE_PC_LIBDIR "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
    set(TSPACE_PC_INCLUDEDIR "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()

# tspace_pkg_config(NAME TARGET COMPONENT DESCRIPTION LIBS)
function(tspace_pkg_config TSPACE_PC_NAME target component TSPACE_PC_DESCRIPTION TSPACE_PC_LIBS)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/tspace.pc.in" "${PROJECT_BINARY_DIR}/package/${TSPACE_PC_NAME}.pc" @ONLY)
    tspace_install_file_of(${target} ${component} "${CMAKE_INSTALL_LIBDIR}/pkgconfig" "${PROJECT_BINARY_DIR}/package/${TSPACE_PC_NAME}.pc")
endfunction()
tspace_pkg_config(tspace tspace tspace_core "${PROJECT_DESCRIPTION}" "-ltspace ${TSPACE_PC_CXX_RUNTIME} -lm -pthread")
# Only the static library has the C++ functions, but -ltspace prefers a shared library in the same folder. A symbolic
# link gives the static library a second name.
tspace_installed_folder(folder "${CMAKE_INSTALL_LIBDIR}")
set(link "${CMAKE_STATIC_LIBRARY_PREFIX}tspace-cpp${CMAKE_STATIC_LIBRARY_SUFFIX}")
install(CODE "if(EXISTS \"$<TARGET_FILE:tspace>\")
    file(CREATE_LINK \"$<TARGET_FILE_NAME:tspace>\" \"\$ENV{DESTDIR}${folder}/${link}\" SYMBOLIC)
endif()" COMPONENT tspace_core)
tspace_pkg_config(tspace-cpp tspace tspace_core "${PROJECT_DESCRIPTION}, in C++" "-ltspace-cpp -lm -pthread")
# tspace-files has a pkg-config file only for the shared library: the static one depends on third-party libraries.
if(TARGET tspace_files_shared)
    tspace_pkg_config(tspace-files tspace_files_shared tspace_files_shared_link "${PROJECT_DESCRIPTION}: model files, in C" "-ltspace-files")
endif()
