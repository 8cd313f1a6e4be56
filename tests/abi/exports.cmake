# Checks that the dynamic symbols of LIBRARY are exactly the functions that HEADERS declare.
cmake_minimum_required(VERSION 3.22)
set(declared "")
foreach(header ${HEADERS})
    file(READ "${header}" text)
    string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" "" text "${text}")
    string(REGEX REPLACE "inline [^{;]*{[^}]*}" "" text "${text}")
    # A function declaration is a type, the function's name and a parenthesis. This excludes macros and function
    # pointers.
    string(REGEX MATCHALL "[a-zA-Z_0-9*] \\*?(tspace_[a-zA-Z]+|genTangSpace[a-zA-Z]*)\\(" names "${text}")
    string(REGEX REPLACE "[^;]* \\*?([a-zA-Z_]+)\\(" "\\1" names "${names}")
    list(APPEND declared ${names})
endforeach()
list(SORT declared)
list(REMOVE_DUPLICATES declared)

execute_process(COMMAND "${NM}" -D --defined-only --format=posix "${LIBRARY}" OUTPUT_VARIABLE exported
                COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "TSPACE_[0-9@]* A[^\n]*\n" "" exported "${exported}")
string(REGEX REPLACE "(@+TSPACE_[0-9]+)? [^\n]*\n" ";" exported "${exported}")
list(SORT exported)
list(REMOVE_ITEM exported "")

list(LENGTH declared count)
if(count LESS 3)
    message(FATAL_ERROR "found only ${count} functions in ${HEADERS}")
endif()
if(NOT declared STREQUAL exported)
    set(missing ${declared})
    list(REMOVE_ITEM missing ${exported})
    list(REMOVE_ITEM exported ${declared})
    message(FATAL_ERROR "declared but not exported: [${missing}]; exported but not declared: [${exported}]")
endif()
message(STATUS "${count} functions")
