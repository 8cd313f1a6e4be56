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

# Installs all of BUILD, anew, into prefix.
function(install_all build)
    file(REMOVE_RECURSE "${FOLDER}/prefix")
    execute_process(COMMAND "${CMAKE_COMMAND}" --install "${build}" --prefix "${FOLDER}/prefix"
                    OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
    set(output "${output}" PARENT_SCOPE)
endfunction()

# find_package(tspace COMPONENTS ...) from there: what it says where it fails, else "found".
file(WRITE "${FOLDER}/consumer/CMakeLists.txt" "cmake_minimum_required(VERSION 3.22)
project(consumer C CXX)
find_package(tspace REQUIRED COMPONENTS \${PARTS})
if(NOT TARGET tspace::tspace OR TARGET tspace::files)
    message(FATAL_ERROR \"not what was built\")
endif()
")
function(find_parts)
    file(REMOVE_RECURSE "${FOLDER}/consumer/build")
    execute_process(COMMAND "${CMAKE_COMMAND}" -S "${FOLDER}/consumer" -B "${FOLDER}/consumer/build" -G "${GENERATOR}"
                            "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_C_COMPILER=${C}" "-DCMAKE_PREFIX_PATH=${FOLDER}/prefix" "-DPARTS=${ARGN}"
                    OUTPUT_QUIET ERROR_VARIABLE said RESULT_VARIABLE failed)
    if(failed EQUAL 0)
        set(said "found")
    endif()
    string(REGEX REPLACE "[ \n]+" " " said "${said}")
    set(said "${said}" PARENT_SCOPE)
endfunction()

function(expect_said regex)
    if(NOT said MATCHES "${regex}")
        message(FATAL_ERROR "find_package does not say ${regex}: ${said}")
    endif()
endfunction()

# What is not there must not be named either: linkers and pkg-config would look for it.
function(expect_none)
    foreach(pattern ${ARGN})
        file(GLOB_RECURSE found "${FOLDER}/prefix/${pattern}")
        if(found)
            message(FATAL_ERROR "installed, but not built: ${found}")
        endif()
    endforeach()
endfunction()

configure(all -DTSPACE_BUILD_TESTS=OFF -DTSPACE_BUILD_SHARED=ON)
install_all("${FOLDER}/all")
foreach(left_out libtspace.a "libtspace.so.0[^\n]*")
    if(NOT output MATCHES "Left out, because it was not built: ${left_out}\n")
        message(FATAL_ERROR "nothing says that ${left_out} was not installed: ${output}")
    endif()
endforeach()
expect_none(libtspace* *.pc tspace-*.cmake)
find_parts(core)
expect_said("installed without its libraries")

if(HAS_TOOL)
    if(NOT output MATCHES "Left out, because it was not built: tspace\n")
        message(FATAL_ERROR "nothing says that the tool was not installed: ${output}")
    endif()
    # What scripts/demo builds; here the files are empty.
    file(TOUCH "${FOLDER}/all/libtspace.a" "${FOLDER}/all/bin/tspace")
    foreach(wing mesh images maps model commands)
        file(TOUCH "${FOLDER}/all/libtspace_${wing}.a")
    endforeach()
    install_all("${FOLDER}/all")
    expect_none(libtspace*.so* libtspace_files.a tspace-files*)
    find_parts(core asset)
    expect_said("^found")
    file(REMOVE "${FOLDER}/all/libtspace_maps.a")
    install_all("${FOLDER}/all")
    find_parts(core)
    expect_said("^found")
    find_parts(core asset)
    expect_said("installed without tspace::asset")
endif()
