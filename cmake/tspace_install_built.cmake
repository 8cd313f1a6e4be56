# Installs only targets that were built, and omits every reference to the others with a message: scripts/demo builds
# only the tool, and users install that build.
include_guard(GLOBAL)
include(GNUInstallDirs)
set(TSPACE_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/tspace")

# tspace_install_built(TARGET COMPONENT ARGUMENTS...): calls install(TARGETS) with these arguments if the target was
# built.
function(tspace_install_built target component)
    install(CODE "if(NOT EXISTS \"$<TARGET_FILE:${target}>\")
        message(STATUS \"Left out, because it was not built: $<TARGET_FILE_NAME:${target}>\")
    endif()" COMPONENT ${component})
    install(TARGETS ${target} ${ARGN} COMPONENT ${component} OPTIONAL)
endfunction()

# Sets `result` to an installation folder, for use in install(CODE).
function(tspace_installed_folder result folder)
    if(IS_ABSOLUTE "${folder}")
        set(${result} "${folder}" PARENT_SCOPE)
    else()
        set(${result} "\${CMAKE_INSTALL_PREFIX}/${folder}" PARENT_SCOPE)
    endif()
endfunction()

# tspace_install_file_of(TARGET COMPONENT FOLDER FILE): installs FILE if the target was built.
function(tspace_install_file_of target component folder file)
    tspace_installed_folder(folder "${folder}")
    install(CODE "if(EXISTS \"$<TARGET_FILE:${target}>\")
        file(INSTALL \"${file}\" DESTINATION \"${folder}\")
    endif()" COMPONENT ${component})
endfunction()

# tspace_install_export(PART COMPONENT TARGET...): installs tspace-PART.cmake, from the export set tspace_PART, if these
# targets were built.
function(tspace_install_export part component)
    install(EXPORT tspace_${part} NAMESPACE tspace:: FILE tspace-${part}.cmake DESTINATION "${TSPACE_CMAKE_DIR}"
            COMPONENT ${component})
    tspace_installed_folder(folder "${TSPACE_CMAKE_DIR}")
    set(files "")
    foreach(target ${ARGN})
        string(APPEND files " \"$<TARGET_FILE:${target}>\"")
    endforeach()
    install(CODE "foreach(library${files})
        file(GLOB exported \"\$ENV{DESTDIR}${folder}/tspace-${part}.cmake\" \"\$ENV{DESTDIR}${folder}/tspace-${part}-*.cmake\")
        if(exported AND NOT EXISTS \"\${library}\")
            file(REMOVE \${exported})
        endif()
    endforeach()" COMPONENT ${component})
endfunction()
