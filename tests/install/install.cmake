# Installs the component tspace_core of BUILD into an empty PREFIX.
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}" --component tspace_core
                COMMAND_ERROR_IS_FATAL ANY)
foreach(header tspace.h tspace.hpp version.h tangents.h compat/mikktspace.h)
    if(NOT EXISTS "${PREFIX}/include/tspace/${header}")
        message(FATAL_ERROR "include/tspace/${header} was not installed")
    endif()
endforeach()
if(EXISTS "${PREFIX}/include/tspace/asset.h")
    message(FATAL_ERROR "the core's component has headers of the asset layer")
endif()
