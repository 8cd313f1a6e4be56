# Configures SOURCE into FOLDER without libraries: what needs them is left out and named in one line, and the core stays.
# Then with all of them, where programs that were not built are left out of an installation.
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE "${FOLDER}")

function(configure name)
    execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${FOLDER}/${name}" -G "${GENERATOR}"
                            "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_C_COMPILER=${C}" ${ARGN}
                    OUTPUT_VARIABLE output ERROR_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
    set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect_line regex)
    string(REGEX MATCHALL "[^\n]*left out:[^\n]*" lines "${output}")
    list(LENGTH lines count)
    if(NOT count EQUAL 1 OR NOT lines MATCHES "${regex}")
        message(FATAL_ERROR "not one line with ${regex}: ${lines}")
    endif()
endfunction()

configure(without_tests -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON -DCMAKE_DISABLE_FIND_PACKAGE_rapidcheck=ON)
expect_line("left out: tests [(].*: libgtest-dev librapidcheck-dev[)]$")

configure(core_alone -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON
          -DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON)
expect_line("asset.*tool.*demo.*tests [(].*nlohmann-json3-dev libfmt-dev")

# What is demanded must be there.
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${FOLDER}/demanded" -G "${GENERATOR}" -DTSPACE_BUILD_TESTS=ON
                        "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_C_COMPILER=${C}" -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON
                OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE failed)
if(failed EQUAL 0)
    message(FATAL_ERROR "tests were demanded, and left out without an error")
endif()

if(HAS_TOOL)
    configure(nothing_built -DTSPACE_BUILD_TESTS=OFF)
    execute_process(COMMAND "${CMAKE_COMMAND}" --install "${FOLDER}/nothing_built" --prefix "${FOLDER}/prefix"
                            --component tspace_tool
                    OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
    if(NOT output MATCHES "Left out, because it was not built: tspace\n")
        message(FATAL_ERROR "nothing says that the tool was not installed: ${output}")
    endif()
endif()
