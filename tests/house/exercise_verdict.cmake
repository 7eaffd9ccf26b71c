# Runs the checks of an exercise (PROGRAM, a Catch2 program) and judges: VARIANT solution must pass; exercise (the
# stub FILE) and near_miss must fail, and by a check: a crash, a hang or an exception does not count.
# A stub that was changed since the last commit is a reader's work: solving it is no fault.
if(NOT SECONDS)
    set(SECONDS 60)  # a hang: checks are made to take a moment
endif()
set(ENV{ASAN_OPTIONS} "abort_on_error=1")  # else a sanitizer's exit code looks like a failed check
set(ENV{UBSAN_OPTIONS} "abort_on_error=1")
set(ENV{TSAN_OPTIONS} "abort_on_error=1")
execute_process(COMMAND "${PROGRAM}" ${CATCH_ARGUMENTS} TIMEOUT ${SECONDS}
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
message("${output}")

if(result STREQUAL "0" AND output MATCHES "All tests passed \\(")
    set(verdict passes)
elseif(result STREQUAL "0")  # std::exit in an answer
    set(verdict "ends before its checks do")
elseif(NOT result MATCHES "^[0-9]+$")  # "Segmentation fault", "Process terminated due to timeout"
    set(verdict "crashes or hangs (${result})")
elseif(output MATCHES "unexpected exception|fatal error condition|Sanitizer:")
    set(verdict "crashes or throws")
elseif(output MATCHES "test cases?: .* failed")
    set(verdict fails)
else()
    set(verdict "ends with ${result} without a failed check")
endif()

if(VARIANT STREQUAL "exercise" AND NOT verdict STREQUAL "fails")
    execute_process(COMMAND bash "${CMAKE_CURRENT_LIST_DIR}/changed_since_commit.sh" "${FILE}" RESULT_VARIABLE result)
    if(result STREQUAL "0")
        message("verdict: solved by a reader, or in work: ${FILE} ${verdict} and differs from the last commit")
        return()
    endif()
endif()
set(wanted fails)
if(VARIANT STREQUAL "solution")
    set(wanted passes)
endif()
if(NOT verdict STREQUAL wanted)
    message(FATAL_ERROR "verdict: ${FILE} ${verdict}; as the ${VARIANT} it should be one that ${wanted}")
endif()
message("verdict: ${verdict}, as it should")
