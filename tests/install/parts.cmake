# First configures SOURCE into FOLDER without any third-party library, and checks that parts that need one are omitted
# and named in one line, and that the core is built. Then configures it with all libraries, and checks that an
# installation omits programs that were not built.
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

if(NOT output MATCHES "no CMAKE_BUILD_TYPE was given, so this is a Release build")
    message(FATAL_ERROR "nothing says which build type was taken: ${output}")
endif()
load_cache("${FOLDER}/core_alone" READ_WITH_PREFIX core_alone_ CMAKE_BUILD_TYPE)
if(NOT core_alone_CMAKE_BUILD_TYPE STREQUAL "Release")
    message(FATAL_ERROR "without a build type it is ${core_alone_CMAKE_BUILD_TYPE}")
endif()

# Parts that are explicitly enabled must be available; otherwise configuration fails.
execute_process(COMMAND "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${FOLDER}/demanded" -G "${GENERATOR}" -DTSPACE_BUILD_TESTS=ON
                        "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_C_COMPILER=${C}" -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON
                OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE failed)
if(failed EQUAL 0)
    message(FATAL_ERROR "tests were demanded, and left out without an error")
endif()

# Installs all of BUILD into an empty prefix.
function(install_all build)
    file(REMOVE_RECURSE "${FOLDER}/prefix")
    execute_process(COMMAND "${CMAKE_COMMAND}" --install "${build}" --prefix "${FOLDER}/prefix"
                    OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
    set(output "${output}" PARENT_SCOPE)
endfunction()

# Runs find_package(tspace COMPONENTS ...) with that prefix; returns its error message, or "found".
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

# Libraries that are absent must not be referenced: otherwise linkers and pkg-config would search for them.
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
    # Empty files in place of the output of scripts/demo.
    file(TOUCH "${FOLDER}/all/libtspace.a" "${FOLDER}/all/bin/tspace")
    foreach(wing mesh images maps textures model commands)
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

# If a component is missing, the message states the reason.
configure(shared -DTSPACE_BUILD_TESTS=OFF -DTSPACE_BUILD_TOOL=OFF -DTSPACE_BUILD_EXAMPLES=OFF -DTSPACE_BUILD_ASSET=OFF -DBUILD_SHARED_LIBS=ON)
load_cache("${FOLDER}/shared" READ_WITH_PREFIX shared_ TSPACE_BUILD_SHARED)
if(NOT shared_TSPACE_BUILD_SHARED)
    message(FATAL_ERROR "BUILD_SHARED_LIBS makes no shared library")
endif()
file(TOUCH "${FOLDER}/shared/libtspace.a")
install_all("${FOLDER}/shared")
find_parts(core shared)
expect_said("without tspace::shared, which had not been built")
find_parts(core asset)
expect_said("without tspace::asset, since TSPACE_BUILD_ASSET was OFF")
find_parts(core maps)
expect_said("no component .maps.: there are core, asset and shared")
file(TOUCH "${FOLDER}/core_alone/libtspace.a")
install_all("${FOLDER}/core_alone")
find_parts(core asset)
expect_said("since libraries were not found, as Debian packages: nlohmann-json3-dev")
find_parts(shared)
expect_said("since TSPACE_BUILD_SHARED was OFF")

# Without TSPACE_INSTALL, which is the default for a subproject, nothing is installed.
configure(no_install -DTSPACE_BUILD_TESTS=OFF -DTSPACE_INSTALL=OFF)
file(TOUCH "${FOLDER}/no_install/libtspace.a" "${FOLDER}/no_install/bin/tspace")
install_all("${FOLDER}/no_install")
expect_none(*)
