# What the project's CMakeLists.txt files are written in: one line per chapter, exercise, figure and test.
# docs/adding_a_chapter.md shows them at work.

set(BOOK_SANITIZE "" CACHE STRING "sanitizers for everything, as in -fsanitize=: \"address,undefined\" or \"thread\"")

# Warnings are errors in our code where the compiler is one of those that tests have seen, but not in what a reader writes
# (a target with the property BOOK_READERS_OWN); other people's headers are system headers. GCC's guesses after inlining, at
# where a pointer leads and what has a value, are left out: they find faults in its own std::string, more or fewer by the
# length of a constant. Floating point is never contracted or reordered (Structures.cmake): exact signs and equal results on
# every machine depend on it.
set(errors "")
if((CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15) OR
   (CMAKE_CXX_COMPILER_ID STREQUAL Clang AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15 AND
    NOT BOOK_SANITIZE MATCHES fuzzer))  # a fuzzer should run, whatever its compiler has to say
    set(errors -Werror)
endif()
set(shadow_in_unity -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
set(guesses -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-restrict)
if(CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)  # what a search for a temporary name returns
    list(APPEND guesses -Wno-dangling-reference)
endif()
add_library(book_flags INTERFACE)
target_compile_features(book_flags INTERFACE cxx_std_20)
target_compile_options(book_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                            # one file's name may be another's parameter
                                            "$<$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>:${shadow_in_unity}>"
                                            $<$<NOT:$<BOOL:$<TARGET_PROPERTY:BOOK_READERS_OWN>>>:${errors}>
                                            "$<$<CXX_COMPILER_ID:GNU>:${guesses}>"
                                            ${SPACE_ARITHMETIC}
                                            # GCC looks through all precompiled headers each time it collects garbage
                                            $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)
target_include_directories(book_flags INTERFACE ${PROJECT_SOURCE_DIR})
if(BOOK_SANITIZE)
    # Tests take smaller sizes where BOOK_SANITIZED is defined (tests/catch.hpp). No look at each pointer before its use,
    # which is half of the compiler's time: a null pointer stops the program anyway, AddressSanitizer sees objects' ends.
    # Nor of two that clang adds; warnings are the other builds'.
    target_compile_options(book_flags INTERFACE -fsanitize=${BOOK_SANITIZE} -fno-sanitize-recover=all
        -fno-sanitize=null,alignment,vptr,object-size,nonnull-attribute,returns-nonnull-attribute,pointer-overflow
        $<$<CXX_COMPILER_ID:Clang>:-fno-sanitize=float-cast-overflow,function> -fno-omit-frame-pointer -w)
    target_compile_definitions(book_flags INTERFACE BOOK_SANITIZED=1)
    target_link_options(book_flags INTERFACE -fsanitize=${BOOK_SANITIZE})
endif()

# Headers that take the compiler longer than most of our sources, compiled once. Others' only, so that a change in ours
# compiles no more than what includes it. They hide where one of them is not included: house.includes_are_whole tells.
set(BOOK_HEADERS <fmt/format.h> <fmt/ranges.h> <glm/glm.hpp> <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem>
                 <functional> <limits> <map> <memory> <optional> <set> <span> <string> <thread> <vector>)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "// Whose headers others share.\n")
add_library(book_headers OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
target_link_libraries(book_headers PRIVATE book_flags fmt::fmt glm::glm)
target_precompile_headers(book_headers PRIVATE ${BOOK_HEADERS})

# book_shares_headers(target)
# For what links book_flags and has no flags of its own that change what the compiler makes of a header.
function(book_shares_headers)
    foreach(target IN LISTS ARGN)
        target_precompile_headers(${target} REUSE_FROM book_headers)
    endforeach()
endfunction()

# book_reads_command_lines(file.cpp ...)
# What CLI11 makes of a command line, once a run: the optimiser would take longer than all the rest.
function(book_reads_command_lines)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON COMPILE_OPTIONS -O0)
endfunction()

# book_compiles_in_batches(target [file that stays alone ...])
# Two files of many each, for two cores: what they include is read once, and the templates that they share are made once.
# No two files of a room may define the same name then; that each includes what it uses is seen by
# house.includes_are_whole.
function(book_compiles_in_batches target)
    get_target_property(sources ${target} SOURCES)
    list(REMOVE_ITEM sources ${ARGN})
    list(LENGTH sources count)
    math(EXPR half "(${count} + 1) / 2")
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${half})
    if(ARGN)
        set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
endfunction()

# book_built("what")  book_left_out("what" "why")
# One line each in the list that ends the configuring.
function(book_built what)
    set_property(GLOBAL APPEND PROPERTY BOOK_BUILT "${what}")
endfunction()
function(book_left_out what why)
    set_property(GLOBAL APPEND PROPERTY BOOK_LEFT_OUT "${what}: ${why}")
endfunction()
function(book_print_summary)
    get_property(built GLOBAL PROPERTY BOOK_BUILT)
    get_property(left_out GLOBAL PROPERTY BOOK_LEFT_OUT)
    message(STATUS "Built:")
    foreach(line IN LISTS built)
        message(STATUS "  + ${line}")
    endforeach()
    if(left_out)
        message(STATUS "Left out:")
        foreach(line IN LISTS left_out)
            message(STATUS "  - ${line}")
        endforeach()
    endif()
endfunction()

# All chapters' programs and nothing else: what a reader needs, whatever state the exercises are in.
add_custom_target(programs)
add_custom_target(benchmarks)
# All programs of unit tests and exercises but the pages': under sanitizers ./book test takes these and what they start.
add_custom_target(test_programs)
find_package(benchmark QUIET)
if(NOT benchmark_FOUND)
    book_left_out("benchmarks" "Google Benchmark is not installed (package libbenchmark-dev)")
endif()

# "ch05_lazy_kd_trees" -> "ch05"
function(book_short_name chapter result)
    string(REGEX MATCH "^ch[0-9][0-9]" short ${chapter})
    set(${result} ${short} PARENT_SCOPE)
endfunction()

# The chapter whose CMakeLists.txt this is: "ch05_lazy_kd_trees", and "ch05".
macro(book_this_chapter)
    cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME chapter)
    book_short_name(${chapter} short)
endmacro()

# add_chapter([BUILDS_ON ch04_kd_trees ...] [LINKS gmp ...])
# In a chapter's CMakeLists.txt, first. The chapter's parts, each with the libraries after LINKS and those of the chapters
# after BUILDS_ON:
#   chNN_library   the subject: its *.cpp and those of folders of its own, but main.cpp (where it has any)
#   chNN_measured  measured/*.cpp (where it has any)
#   the program    main.cpp and figures/*.cpp
#   chNN_tables    main.cpp alone, for ./book try and for sanitizers, under which no test makes a figure
#   chNN_benchmarks  measured/benchmarks.cpp
# and a test that --small prints measured/expected_small.txt.
function(add_chapter)
    cmake_parse_arguments(ARG "" "" "BUILDS_ON;LINKS" ${ARGN})
    book_this_chapter()
    set(dir ${CMAKE_CURRENT_SOURCE_DIR})
    set_property(GLOBAL APPEND PROPERTY BOOK_CHAPTERS ${chapter})
    set_property(GLOBAL PROPERTY BOOK_${chapter}_BUILDS_ON ${ARG_BUILDS_ON})

    file(GLOB subject CONFIGURE_DEPENDS ${dir}/*.cpp ${dir}/*/*.cpp)
    list(FILTER subject EXCLUDE REGEX "/main\\.cpp$|/(figures|measured|exercises|solutions|near_misses|checks|peers)/[^/]*$")
    file(GLOB measured CONFIGURE_DEPENDS ${dir}/measured/*.cpp)
    list(REMOVE_ITEM measured ${dir}/measured/benchmarks.cpp)
    file(GLOB figures CONFIGURE_DEPENDS ${dir}/figures/*.cpp)

    set(libraries book_common ${ARG_LINKS})
    foreach(below IN LISTS ARG_BUILDS_ON)
        book_short_name(${below} below)
        if(TARGET ${below}_library)
            list(APPEND libraries ${below}_library)
        endif()
    endforeach()
    if(subject)
        add_library(${short}_library STATIC ${subject})
        target_link_libraries(${short}_library PUBLIC ${libraries} PRIVATE book_flags)
        book_shares_headers(${short}_library)
        set(libraries ${short}_library)
    endif()
    set_property(GLOBAL PROPERTY BOOK_${chapter}_SUBJECT ${libraries})
    if(measured)
        add_library(${short}_measured STATIC ${measured})
        target_link_libraries(${short}_measured PUBLIC ${libraries} PRIVATE book_flags)
        book_shares_headers(${short}_measured)
        book_compiles_in_batches(${short}_measured)
        set(libraries ${short}_measured)
    endif()
    set_property(GLOBAL PROPERTY BOOK_${chapter}_LIBRARIES ${libraries})
    if(NOT EXISTS ${dir}/main.cpp)
        book_left_out("chapter ${chapter}" "it has no program yet")
        return()
    endif()
    set(register ${CMAKE_CURRENT_BINARY_DIR}/figure_register.cpp)
    add_executable(${chapter} ${dir}/main.cpp ${figures} ${register})
    book_compiles_in_batches(${chapter} ${register})
    target_link_libraries(${chapter} PRIVATE ${libraries} book_flags)
    target_include_directories(${chapter} PRIVATE ${PROJECT_BINARY_DIR}/register)
    target_compile_options(${chapter} PRIVATE -Wmissing-declarations)  # finds a figure without an add_figure line
    book_shares_headers(${chapter})
    cmake_language(DEFER CALL book_write_register)
    set_target_properties(${chapter} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
    add_dependencies(programs ${chapter})
    book_built("chapter ${chapter}")

    # For ./book try, the same without figures, which are most of what a change of the subject compiles.
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/no_figures.cpp CONTENT
"#include \"common/program/chapter.hpp\"

const space::Chapter space::this_chapter{\"${chapter}\", {}};
" @ONLY)
    add_executable(${short}_tables ${dir}/main.cpp ${CMAKE_CURRENT_BINARY_DIR}/no_figures.cpp)
    target_link_libraries(${short}_tables PRIVATE ${libraries} book_flags)
    book_shares_headers(${short}_tables)
    set_target_properties(${short}_tables PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
    set(tested ${chapter})
    set(other ${short}_tables)
    if(BOOK_SANITIZE AND figures)
        set(tested ${short}_tables)
        set(other ${chapter})
    endif()
    set_target_properties(${other} PROPERTIES EXCLUDE_FROM_ALL ON)

    if(EXISTS ${dir}/measured/benchmarks.cpp AND benchmark_FOUND)
        add_executable(${short}_benchmarks EXCLUDE_FROM_ALL ${dir}/measured/benchmarks.cpp)
        target_link_libraries(${short}_benchmarks PRIVATE ${libraries} book_flags benchmark::benchmark_main)
        book_shares_headers(${short}_benchmarks)
        set_target_properties(${short}_benchmarks PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
        add_dependencies(benchmarks ${short}_benchmarks)
    endif()
    file(GLOB expected CONFIGURE_DEPENDS ${dir}/measured/expected_small.txt)  # once it is there, the next build sees it
    if(expected)
        set(threads "1 3")
        if(BOOK_SANITIZE)  # memory and threads; that their number doesn't matter is seen elsewhere
            set(threads 3)
        endif()
        add_test(NAME ${short}.small COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${tested}> -D THREADS=${threads}
                 -D EXPECTED=${dir}/measured/expected_small.txt -D OUT=${PROJECT_BINARY_DIR}/small/${chapter}
                 -P ${PROJECT_SOURCE_DIR}/tests/house/compare_small.cmake)
        set_tests_properties(${short}.small PROPERTIES LABELS chapter TIMEOUT 300 FIXTURES_SETUP small_runs)
    endif()
    if(measured)  # it writes results
        add_test(NAME ${short}.out_is_checked_first COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${tested}>
                 -D OUT=${dir}/main.cpp/no_directory -P ${PROJECT_SOURCE_DIR}/tests/house/out_is_checked_first.cmake)
        set_tests_properties(${short}.out_is_checked_first PROPERTIES LABELS chapter TIMEOUT 60)
    endif()
endfunction()

# book_find_embree("what is left out without it")
# In a chapter's CMakeLists.txt, after add_chapter: it is measured beside Embree 3 (Debian 12) or 4 (Debian 13), where that
# is installed. Its files in measured/ see BOOK_HAS_EMBREE.
function(book_find_embree what)
    book_this_chapter()
    foreach(version 4 3)
        find_library(EMBREE_LIBRARY embree${version})
    endforeach()
    if(NOT EMBREE_LIBRARY)
        book_left_out("${what}" "it is not installed (package libembree-dev)")
    elseif(TARGET ${short}_measured)
        target_link_libraries(${short}_measured PUBLIC ${EMBREE_LIBRARY})
        target_compile_definitions(${short}_measured PRIVATE BOOK_HAS_EMBREE=1)
    endif()
endfunction()

# add_figure(fig_01_03 drawing|rendering|chart "caption" [SLOW])
# Names a figure that the chapter's program makes with --figure: by a function of that name in the chapter's namespace,
#   Svg fig_01_03(const Options&), for a rendering Image fig_01_03(...), for a chart Chart fig_01_03(...),
# declared in the header "chapters/CHAPTER/figures.hpp", which is made from these lines. The caption stands below the
# figure in the gallery, and in the text where \fig_01_03 stands. Drawings and renderings have the same bytes
# everywhere: a test makes them again and compares them with those in figures/. Charts show measured times. What is SLOW
# takes minutes: it is made by a full run or when it is asked for by its id, and is not tested.
function(add_figure id kind caption)
    book_this_chapter()
    cmake_parse_arguments(ARG "SLOW" "" "" ${ARGN})
    string(TOLOWER "${ARG_SLOW}" slow)
    if(NOT kind MATCHES "^(drawing|rendering|chart)$")
        message(FATAL_ERROR "add_figure ${id}: kind ${kind} is none of drawing, rendering, chart")
    endif()
    string(REPLACE "\\" "\\\\" caption "${caption}")
    string(REPLACE "\"" "\\\"" caption "${caption}")
    string(REPLACE ";" "\\;" caption "${caption}")
    string(JOIN ", " entry "\"id\": \"${id}\"" "\"chapter\": \"${chapter}\"" "\"kind\": \"${kind}\""
           "\"slow\": ${slow}" "\"caption\": \"${caption}\"")
    set_property(GLOBAL APPEND PROPERTY BOOK_FIGURES "{${entry}}")
    set_property(DIRECTORY APPEND PROPERTY BOOK_REGISTER "${id} ${kind}")
    if(slow OR kind STREQUAL "chart")
        return()
    endif()
    set(suffix svg)
    if(kind STREQUAL "rendering")
        set(suffix png)
    endif()
    add_test(NAME ${short}.${id} COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${chapter}> -D FIGURE=${id}
             -D SUFFIX=${suffix} -D REFERENCES=${PROJECT_SOURCE_DIR}/figures -D OUT=${PROJECT_BINARY_DIR}/figures
             -P ${PROJECT_SOURCE_DIR}/tests/house/compare_figure.cmake)
    set_tests_properties(${short}.${id} PROPERTIES LABELS "figure;no_sanitizer" TIMEOUT 300)
endfunction()

# The register of a chapter's figures in C++, from its add_figure lines: the header that declares their functions (who
# defines one includes it, so that the compiler sees the kind), and the table for the program.
function(book_write_register)
    book_this_chapter()
    set(type_drawing Svg)
    set(type_rendering Image)
    set(type_chart Chart)
    get_property(lines DIRECTORY PROPERTY BOOK_REGISTER)
    set(declarations "")
    set(entries "")
    foreach(line IN LISTS lines)
        string(REGEX MATCH "^([^ ]+) ([^ ]+)$" line "${line}")
        string(APPEND declarations "${type_${CMAKE_MATCH_2}} ${CMAKE_MATCH_1}(const Options& options);\n")
        string(APPEND entries "    {\"${CMAKE_MATCH_1}\", ${short}::${CMAKE_MATCH_1}},\n")
    endforeach()
    set(made "// Made by common/cmake/Book.cmake from the add_figure lines of chapters/${chapter}/CMakeLists.txt.\n")
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/register/chapters/${chapter}/figures.hpp CONTENT
"${made}#pragma once

#include \"common/program/figure.hpp\"

namespace space::${short} {

${declarations}
}  // namespace space::${short}
" @ONLY)
    set(table "constexpr std::span<const Figure> figures;\n")
    if(entries)
        set(table "constexpr Figure figures[] = {\n${entries}};\n")
    endif()
    file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/figure_register.cpp CONTENT
"${made}#include \"common/program/chapter.hpp\"

#include \"chapters/${chapter}/figures.hpp\"

namespace space {
namespace {

${table}
}  // namespace

const Chapter this_chapter{\"${chapter}\", figures};

}  // namespace space
" @ONLY)
endfunction()

# Catch2, compiled once; a program without test cases fails (version 3 does that unasked).
find_package(Catch2)
if(NOT Catch2_FOUND)
    book_left_out("unit tests and checks of exercises" "Catch2 is not installed (package catch2)")
elseif(Catch2_VERSION VERSION_LESS 3)
    add_subdirectory(${PROJECT_SOURCE_DIR}/common/cmake/catch2 catch2)
    set(BOOK_CATCH_ARGUMENTS -w NoTests)
else()
    add_library(book_catch_main INTERFACE)
    target_link_libraries(book_catch_main INTERFACE Catch2::Catch2WithMain)
    set(BOOK_CATCH_ARGUMENTS)
endif()

# As BOOK_HEADERS, with Catch2's. Tests and checks run once: -O2 would take a third more of the compiler's time than -O1
# and save none of theirs; under sanitizers the optimiser as such takes longer than it saves. The later of two -O wins.
set(test_options -O1)
if(BOOK_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL Debug)
    set(test_options -O0)
endif()
if(TARGET book_catch_main)
    add_library(book_test_headers OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
    target_link_libraries(book_test_headers PRIVATE book_catch_main book_common book_flags)
    target_compile_options(book_test_headers PRIVATE ${test_options})
    target_precompile_headers(book_test_headers PRIVATE ${PROJECT_SOURCE_DIR}/tests/catch.hpp ${BOOK_HEADERS})

    # How values print in the checks of exercises.
    add_library(book_check STATIC ${PROJECT_SOURCE_DIR}/tests/check.cpp)
    target_link_libraries(book_check PRIVATE book_flags PUBLIC book_common Catch2::Catch2)
    target_compile_options(book_check PRIVATE ${test_options})
    target_precompile_headers(book_check REUSE_FROM book_test_headers)
endif()

# There are hundreds of them, which gold links in a third of the time. What is measured is linked as everywhere.
find_program(BOOK_GOLD ld.gold)
mark_as_advanced(BOOK_GOLD)

# book_uses_catch(target)
# For a test program that links everything else already.
function(book_uses_catch target)
    target_link_libraries(${target} PRIVATE book_catch_main)
    target_compile_options(${target} PRIVATE ${test_options})
    if(BOOK_GOLD)
        target_link_options(${target} PRIVATE -fuse-ld=gold)
    endif()
    get_target_property(libraries ${target} LINK_LIBRARIES)
    if("CGAL::CGAL" IN_LIST libraries)
        return()  # its flag -frounding-math wants headers of its own
    endif()
    target_precompile_headers(${target} REUSE_FROM book_test_headers)
endfunction()

# add_exercise(ex01_erased_hit)
# Compiles checks/<name>.cpp three times: against the reader's exercises/<name>.hpp, the solution and the near miss.
# Tests: the untouched stub fails by its checks, the solution passes, the near miss is caught. Sanitizers see the solution
# only: minutes of compiling less.
function(add_exercise name)
    book_this_chapter()
    set(dir ${CMAKE_CURRENT_SOURCE_DIR})
    set_property(GLOBAL APPEND PROPERTY BOOK_EXERCISES "${chapter}/${name}")
    if(NOT TARGET book_catch_main)
        return()
    endif()
    set(variants exercise solution near_miss)
    if(BOOK_SANITIZE)
        set(variants solution)
    endif()
    foreach(variant IN LISTS variants)
        book_exercise_folder(${variant})
        if(NOT EXISTS ${dir}/checks/${name}.cpp OR NOT EXISTS ${dir}/${folder}/${name}.hpp)
            continue()  # the test "every exercise is whole" tells
        endif()
        # What forbids names to the answer, adds to namespaces or is there for the whole program cannot stand with others.
        file(STRINGS ${dir}/checks/${name}.cpp peculiar REGEX
             "^#pragma|^namespace [A-Za-z]|^struct std::|operator new|include .*/measured/")
        if(variant STREQUAL "exercise" OR peculiar)
            set(target ${short}.${name}.${variant})
            book_exercise_program(${target} ${variant} ${dir}/checks/${name}.cpp)
            book_exercise_test(${name} ${variant} ${target})
        else()
            set_property(DIRECTORY APPEND PROPERTY BOOK_${variant}_TOGETHER ${name})
        endif()
    endforeach()
    get_property(is_deferred DIRECTORY PROPERTY BOOK_EXERCISES_DEFERRED)
    if(NOT is_deferred)
        set_property(DIRECTORY PROPERTY BOOK_EXERCISES_DEFERRED ON)
        cmake_language(DEFER CALL book_exercises_together)
    endif()
endfunction()

# "near_miss" -> folder near_misses
macro(book_exercise_folder variant)
    set(folder ${variant}s)
    if(${variant} STREQUAL "near_miss")
        set(folder near_misses)
    endif()
endmacro()

# book_exercise_program(target exercise|solution|near_miss checks.cpp)
function(book_exercise_program target variant source)
    book_this_chapter()
    book_exercise_folder(${variant})
    set(measured "")
    file(STRINGS ${source} measured REGEX "include .*/measured/")
    if(measured)
        get_property(libraries GLOBAL PROPERTY BOOK_${chapter}_LIBRARIES)
    else()  # what is measured need not be compiled for it
        get_property(libraries GLOBAL PROPERTY BOOK_${chapter}_SUBJECT)
    endif()
    add_executable(${target} ${source})
    target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/${folder})
    target_link_libraries(${target} PRIVATE book_check ${libraries} book_flags)
    book_uses_catch(${target})
    set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/exercises)
    add_dependencies(test_programs ${target})
    if(variant STREQUAL "exercise")
        set_target_properties(${target} PROPERTIES BOOK_READERS_OWN ON)
    endif()
endfunction()

# book_exercise_test(ex01_erased_hit exercise|solution|near_miss program [arguments of Catch2's])
function(book_exercise_test name variant program)
    book_this_chapter()
    book_exercise_folder(${variant})
    set(test ${short}.${name}.${variant})
    add_test(NAME ${test} COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${program}> -D VARIANT=${variant}
             -D "CATCH_ARGUMENTS=${BOOK_CATCH_ARGUMENTS};${ARGN}" -D FILE=${CMAKE_CURRENT_SOURCE_DIR}/${folder}/${name}.hpp
             -P ${PROJECT_SOURCE_DIR}/tests/house/exercise_verdict.cmake)
    set_tests_properties(${test} PROPERTIES LABELS exercise TIMEOUT 120)
    if(variant STREQUAL "exercise")
        set_tests_properties(${test} PROPERTIES SKIP_REGULAR_EXPRESSION "verdict: solved by a reader")
    endif()
endfunction()

# A chapter's solutions are compiled as one file, and so are its near misses: a third of the time. First all that the checks
# include, the answers too, then each check in a namespace of its own. That each compiles alone is seen with the stubs.
function(book_exercises_together)
    book_this_chapter()
    foreach(variant solution near_miss)
        get_property(names DIRECTORY PROPERTY BOOK_${variant}_TOGETHER)
        if(NOT names)
            continue()
        endif()
        set(includes "")
        set(checks "")
        foreach(name IN LISTS names)
            set(check ${CMAKE_CURRENT_SOURCE_DIR}/checks/${name}.cpp)
            set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${check})
            file(STRINGS ${check} included REGEX "^#include")
            list(APPEND includes ${included})
            string(REGEX MATCH "^ex[0-9]+" number ${name})
            string(APPEND checks "namespace ${short}_${number} {\n#include \"${check}\"\n}\n")
        endforeach()
        list(REMOVE_DUPLICATES includes)
        list(JOIN includes "\n" includes)
        set(source ${CMAKE_CURRENT_BINARY_DIR}/${variant}_checks.cpp)
        file(CONFIGURE OUTPUT ${source} CONTENT "${includes}\n${checks}" @ONLY)
        book_exercise_program(${short}.${variant}_checks ${variant} ${source})
        set_target_properties(${short}.${variant}_checks PROPERTIES UNITY_BUILD ON)  # what -Wshadow is to know
        foreach(name IN LISTS names)
            book_exercise_test(${name} ${variant} ${short}.${variant}_checks --filenames-as-tags "[#${name}]~[.]")
        endforeach()
    endforeach()
endfunction()

# add_book_test(name SOURCES a.cpp ... [PROGRAM program] [LIBRARIES ...] [DEFINES NAME="text" ...] [RUNS NAME=target ...]
#               [LABELS ...])
# A Catch2 program and a test that runs it; a program without test cases fails. After RUNS stand programs that it starts,
# each with the name by which it finds the file. Tests of one PROGRAM are compiled together, some files at a time: what
# they include is read once, and the templates that they share are made once. Their files define no name twice. Label
# no_sanitizer: neither compiled nor run under sanitizers, for tests of numbers whose code other tests take through memory
# and threads.
function(add_book_test name)
    cmake_parse_arguments(ARG "" "PROGRAM" "SOURCES;LIBRARIES;DEFINES;RUNS;LABELS" ${ARGN})
    if(BOOK_SANITIZE AND "no_sanitizer" IN_LIST ARG_LABELS)
        return()
    endif()
    set(program ${name})
    set(chosen "")
    if(ARG_PROGRAM)
        set(program ${ARG_PROGRAM})
        set(tags ${ARG_SOURCES})
        list(FILTER tags INCLUDE REGEX "_test\\.cpp$")  # others have no test cases
        list(TRANSFORM tags REPLACE "(.+)\\.cpp" "[#\\1]~[.]")
        list(JOIN tags "," tags)
        set(chosen --filenames-as-tags ${tags})
    endif()
    if(TARGET ${program})
        target_sources(${program} PRIVATE ${ARG_SOURCES})
        target_link_libraries(${program} PRIVATE ${ARG_LIBRARIES})
    else()
        add_executable(${program} ${ARG_SOURCES})
        target_link_libraries(${program} PRIVATE book_common book_flags ${ARG_LIBRARIES})
        book_uses_catch(${program})
        set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    endif()
    if(NOT "docs" IN_LIST ARG_LABELS)
        add_dependencies(test_programs ${program})
        list(APPEND ARG_LABELS unit)
    endif()
    if(ARG_PROGRAM)
        set_target_properties(${program} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 5)
    endif()
    target_compile_definitions(${program} PRIVATE ${ARG_DEFINES})
    foreach(started IN LISTS ARG_RUNS)
        string(REGEX MATCH "^(.*)=(.*)$" started ${started})
        target_compile_definitions(${program} PRIVATE ${CMAKE_MATCH_1}="$<TARGET_FILE:${CMAKE_MATCH_2}>")
        add_dependencies(${program} ${CMAKE_MATCH_2})
    endforeach()
    add_test(NAME ${name} COMMAND ${program} ${BOOK_CATCH_ARGUMENTS} ${chosen})
    # Before the hundreds of short ones, figures and exercises, which leave no core waiting at the end.
    set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 900 COST 10)
endfunction()

# The lists that the command, the tests and the pages read: figures.json, exercises.txt, chapters.txt,
# catch_arguments.txt.
function(book_write_lists)
    get_property(figures GLOBAL PROPERTY BOOK_FIGURES)
    list(JOIN figures ",\n " figures)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/figures.json CONTENT "[${figures}]\n" @ONLY)

    get_property(exercises GLOBAL PROPERTY BOOK_EXERCISES)
    list(JOIN exercises "\n" exercises)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/exercises.txt CONTENT "${exercises}\n" @ONLY)

    get_property(chapters GLOBAL PROPERTY BOOK_CHAPTERS)
    set(lines "")
    foreach(chapter IN LISTS chapters)
        get_property(below GLOBAL PROPERTY BOOK_${chapter}_BUILDS_ON)
        list(JOIN below " " below)
        string(APPEND lines "${chapter} ${below}\n")
    endforeach()
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/chapters.txt CONTENT "${lines}" @ONLY)

    list(JOIN BOOK_CATCH_ARGUMENTS " " arguments)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/catch_arguments.txt CONTENT "${arguments}\n" @ONLY)
endfunction()
