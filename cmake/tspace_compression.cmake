# The codecs of compressed glTF: TSPACE_WITH_MESHOPT and TSPACE_WITH_DRACO are ON where the library is found. Set one to
# OFF to build without it; files that need it are then refused with a message that says so.
foreach(codec MESHOPT DRACO)
    if(codec STREQUAL MESHOPT)
        set(package meshoptimizer)
    else()
        set(package draco)
    endif()
    find_package(${package} QUIET)
    tspace_optional(${codec} "Compressed glTF by the library ${package}" "the library ${package} was" ${package}_FOUND)
endforeach()
