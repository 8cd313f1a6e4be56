# What every consumer builds and runs: both quick starts and an engine with the MikkTSpace interface. LINK is what the
# targets link to; COMPAT_DIR is the folder of mikktspace.h.
enable_testing()  # in the function it would be forgotten at its end
function(tspace_add_consumers link compat_dir)
    get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
    add_executable(quickstart_c "${TSPACE_SOURCE_DIR}/examples/quickstart.c")
    add_executable(engine "${TSPACE_SOURCE_DIR}/tests/core/c_api/c_mikktspace_test.c")
    target_include_directories(engine PRIVATE "${compat_dir}")
    set(programs quickstart_c engine)
    if("CXX" IN_LIST languages)
        add_executable(quickstart_cpp "${TSPACE_SOURCE_DIR}/examples/quickstart.cpp")
        target_compile_features(quickstart_cpp PRIVATE cxx_std_20)
        list(APPEND programs quickstart_cpp)
    endif()
    foreach(program IN LISTS programs)
        target_link_libraries(${program} PRIVATE ${link})
        add_test(NAME ${program} COMMAND ${program})
    endforeach()
endfunction()
