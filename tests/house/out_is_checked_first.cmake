# A program that can't write where it is told to says so in one line before its work, and prints nothing else.
# cmake -D PROGRAM=FILE -D OUT=DIRECTORY -P out_is_checked_first.cmake
execute_process(COMMAND ${PROGRAM} --small --out ${OUT} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
if(result EQUAL 0 OR NOT output STREQUAL "" OR NOT errors MATCHES "^[^\n]*no_directory[^\n]*\n$")
    message(FATAL_ERROR "exit code ${result}, stdout '${output}', stderr '${errors}'")
endif()
