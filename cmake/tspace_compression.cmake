# The codecs of compressed glTF: TSPACE_WITH_MESHOPT and TSPACE_WITH_DRACO are ON where the library is found. Set one to
# OFF to build without it; files that need it are then refused with a message that says so.
foreach(codec MESHOPT DRACO)
    if(codec STREQUAL MESHOPT)
        set(package meshoptimizer)
    else()
        set(package draco)
    endif()
    find_package(${package} QUIET)
    option(TSPACE_WITH_${codec} "Compressed glTF by the library ${package}" ${${package}_FOUND})
    if(TSPACE_WITH_${codec} AND NOT ${package}_FOUND)
        message(FATAL_ERROR "TSPACE_WITH_${codec} is ON, but the library ${package} was not found")
    endif()
endforeach()
