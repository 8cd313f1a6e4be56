# Codecs of compressed glTF: TSPACE_WITH_MESHOPT and TSPACE_WITH_DRACO are ON if the library is found. If one is set to
# OFF, files that need the codec are rejected with a message that names it.
foreach(codec MESHOPT DRACO)
    if(codec STREQUAL MESHOPT)
        set(package meshoptimizer)
    else()
        set(package draco)
    endif()
    find_package(${package} QUIET)
    tspace_optional(${codec} "Compressed glTF by the library ${package}" "the library ${package} was" ${package}_FOUND)
endforeach()
