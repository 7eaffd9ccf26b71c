# Every class, concept and enumeration of the book says what it is for. Functions and fields whose names and types say it
# all need no sentence; Doxygen cannot tell these apart, so its warnings are sorted here.
file(MAKE_DIRECTORY ${OUT})
file(READ ${DOXYFILE} settings)
file(WRITE ${OUT}/Doxyfile "${settings}
GENERATE_HTML = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
OUTPUT_DIRECTORY = ${OUT}
FILE_PATTERNS = *.hpp
WARN_AS_ERROR = NO
WARN_IF_UNDOCUMENTED = YES
WARN_LOGFILE = ${OUT}/warnings.txt
")
execute_process(COMMAND ${DOXYGEN} ${OUT}/Doxyfile OUTPUT_QUIET ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(STRINGS ${OUT}/warnings.txt undocumented
     REGEX "Compound .* is not documented|\\((enumeration|concept)\\) of (namespace|file) .* is not documented")
foreach(line IN LISTS undocumented)
    message("${line}")
endforeach()
if(undocumented)
    message(FATAL_ERROR "these need a sentence")
endif()
