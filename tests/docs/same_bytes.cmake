# The site made again is the same, byte for byte.
execute_process(COMMAND ${MAKE_SITE} --out ${SITE}.again OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND diff -rq ${SITE} ${SITE}.again RESULT_VARIABLE differs)
file(REMOVE_RECURSE ${SITE}.again)
if(NOT differs EQUAL 0)
    message(FATAL_ERROR "the site differs from one making to the next")
endif()
