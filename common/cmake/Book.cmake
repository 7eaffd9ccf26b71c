# What the project's CMakeLists.txt files are written in: one line per chapter, exercise, figure and test.
# docs/adding_a_chapter.md shows them at work.

set(BOOK_SANITIZE "" CACHE STRING "sanitizers for everything, as in -fsanitize=: \"address,undefined\" or \"thread\"")

# Warnings are errors in our code; other people's headers are system headers. Floating point is never contracted or
# reordered: exact signs and equal results on every machine depend on it (DESIGN: accuracy).
add_library(book_flags INTERFACE)
target_compile_features(book_flags INTERFACE cxx_std_20)
target_compile_options(book_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
                                            -ffp-contract=off)
target_include_directories(book_flags INTERFACE ${PROJECT_SOURCE_DIR})
if(BOOK_SANITIZE)
    # Tests may ask for BOOK_SANITIZED to take smaller sizes: sanitized code is some ten times slower. GCC 12 then sees
    # uninitialised values in std::regex and std::function where there are none.
    target_compile_options(book_flags INTERFACE -fsanitize=${BOOK_SANITIZE} -fno-sanitize-recover=all
                                                -fno-omit-frame-pointer -Wno-maybe-uninitialized)
    target_compile_definitions(book_flags INTERFACE BOOK_SANITIZED=1)
    target_link_options(book_flags INTERFACE -fsanitize=${BOOK_SANITIZE})
endif()

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
find_package(benchmark QUIET)
if(NOT benchmark_FOUND)
    book_left_out("benchmarks" "Google Benchmark is not installed (package libbenchmark-dev)")
endif()

# "ch05_lazy_kd_trees" -> "ch05"
function(book_short_name chapter result)
    string(REGEX MATCH "^ch[0-9][0-9]" short ${chapter})
    set(${result} ${short} PARENT_SCOPE)
endfunction()

# book_link_chapters(target chapter ...)
# Links what the chapters' headers leave to their libraries.
function(book_link_chapters target)
    foreach(chapter IN LISTS ARGN)
        book_short_name(${chapter} short)
        if(TARGET ${short}_library)
            target_link_libraries(${target} PRIVATE ${short}_library)
        endif()
    endforeach()
endfunction()

# add_chapter(ch05_lazy_kd_trees [BUILDS_ON ch04_kd_trees ...] [LIBRARY file.cpp ...] [LINKS gmp ...])
# Builds the chapter's *.cpp (main.cpp, figures.cpp) into the program <name>, and tests that --small prints
# expected_small.txt; its benchmarks.cpp becomes the program chNN_benchmarks. The files after LIBRARY, which later chapters
# and tests need too, become the library chNN_library, with the libraries after LINKS. The chapter's own CMakeLists.txt
# holds its exercises and figures.
function(add_chapter name)
    cmake_parse_arguments(ARG "" "" "BUILDS_ON;LIBRARY;LINKS" ${ARGN})
    set(dir ${PROJECT_SOURCE_DIR}/chapters/${name})
    book_short_name(${name} short)
    file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.cpp)
    list(REMOVE_ITEM sources ${dir}/benchmarks.cpp)
    set_property(GLOBAL APPEND PROPERTY BOOK_CHAPTERS ${name})
    set_property(GLOBAL PROPERTY BOOK_${name}_BUILDS_ON ${ARG_BUILDS_ON})
    if(ARG_LIBRARY)
        list(TRANSFORM ARG_LIBRARY PREPEND ${dir}/)
        list(REMOVE_ITEM sources ${ARG_LIBRARY})
        add_library(${short}_library STATIC ${ARG_LIBRARY})
        target_link_libraries(${short}_library PUBLIC book_common ${ARG_LINKS} PRIVATE book_flags)
        book_link_chapters(${short}_library ${ARG_BUILDS_ON})
    endif()
    if(NOT EXISTS ${dir}/main.cpp)
        book_left_out("chapter ${name}" "it has no program yet")
        return()
    endif()
    add_executable(${name} ${sources})
    target_link_libraries(${name} PRIVATE book_common book_flags)
    book_link_chapters(${name} ${name} ${ARG_BUILDS_ON})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
    add_dependencies(programs ${name})
    book_built("chapter ${name}")

    if(EXISTS ${dir}/benchmarks.cpp AND benchmark_FOUND)
        add_executable(${short}_benchmarks EXCLUDE_FROM_ALL ${dir}/benchmarks.cpp)
        target_link_libraries(${short}_benchmarks PRIVATE book_common book_flags benchmark::benchmark_main)
        book_link_chapters(${short}_benchmarks ${name} ${ARG_BUILDS_ON})
        set_target_properties(${short}_benchmarks PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
        add_dependencies(benchmarks ${short}_benchmarks)
    endif()
    if(EXISTS ${dir}/expected_small.txt)
        add_test(NAME ${short}.small COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${name}>
                 -D EXPECTED=${dir}/expected_small.txt -D OUT=${PROJECT_BINARY_DIR}/small/${name}
                 -P ${PROJECT_SOURCE_DIR}/tests/house/compare_small.cmake)
        set_tests_properties(${short}.small PROPERTIES LABELS chapter TIMEOUT 300)
    endif()
    if(EXISTS ${dir}/measurements.cpp)  # it writes results
        add_test(NAME ${short}.out_is_checked_first COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${name}>
                 -D OUT=${dir}/main.cpp/no_directory -P ${PROJECT_SOURCE_DIR}/tests/house/out_is_checked_first.cmake)
        set_tests_properties(${short}.out_is_checked_first PROPERTIES LABELS chapter TIMEOUT 60)
    endif()
    if(EXISTS ${dir}/CMakeLists.txt)
        add_subdirectory(${dir} ${PROJECT_BINARY_DIR}/chapters/${name})
    endif()
endfunction()

# add_figure(ch01_naive_ray_tracing fig_01_03 drawing|rendering|chart "caption" [SLOW])
# Names a figure that the chapter's program makes with --figure. Drawings and renderings have the same bytes
# everywhere: a test makes them again and compares them with those in figures/. Charts show measured times. What is SLOW
# takes minutes: it is made by a full run or when it is asked for by its id, and is not tested.
function(add_figure chapter id kind caption)
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
    if(slow OR kind STREQUAL "chart")
        return()
    endif()
    book_short_name(${chapter} short)
    set(suffix svg)
    if(kind STREQUAL "rendering")
        set(suffix png)
    endif()
    add_test(NAME ${short}.${id} COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${chapter}> -D FIGURE=${id}
             -D SUFFIX=${suffix} -D REFERENCES=${PROJECT_SOURCE_DIR}/figures -D OUT=${PROJECT_BINARY_DIR}/figures
             -P ${PROJECT_SOURCE_DIR}/tests/house/compare_figure.cmake)
    set_tests_properties(${short}.${id} PROPERTIES LABELS "figure;no_sanitizer" TIMEOUT 300)
endfunction()

# Catch2, compiled once; a program without test cases fails (version 3 does that unasked).
find_package(Catch2)
if(NOT Catch2_FOUND)
    book_left_out("unit tests and checks of exercises" "Catch2 is not installed (package catch2)")
elseif(Catch2_VERSION VERSION_LESS 3)
    add_library(book_catch_main OBJECT ${PROJECT_SOURCE_DIR}/tests/catch_main.cpp)
    # Others' code, and minutes of compiling with optimiser and sanitizers: it gets neither.
    target_compile_options(book_catch_main PRIVATE -std=c++20 -O0)
    target_include_directories(book_catch_main PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(book_catch_main PUBLIC Catch2::Catch2)
    set(BOOK_CATCH_ARGUMENTS -w NoTests)
else()
    add_library(book_catch_main INTERFACE)
    target_link_libraries(book_catch_main INTERFACE Catch2::Catch2WithMain)
    set(BOOK_CATCH_ARGUMENTS)
endif()

# add_exercise(ch01_naive_ray_tracing ex01_erased_hit)
# Compiles checks/<name>.cpp three times: against the reader's exercises/<name>.hpp, the solution and the near miss.
# Tests: the untouched stub fails by its checks, the solution passes, the near miss is caught. Sanitizers see the solution
# only: minutes of compiling less.
function(add_exercise chapter name)
    book_short_name(${chapter} short)
    set(dir ${PROJECT_SOURCE_DIR}/chapters/${chapter})
    set_property(GLOBAL APPEND PROPERTY BOOK_EXERCISES "${chapter}/${name}")
    if(NOT TARGET book_catch_main)
        return()
    endif()
    set(variants exercise solution near_miss)
    if(BOOK_SANITIZE)
        set(variants solution)
    endif()
    foreach(variant IN LISTS variants)
        set(folder ${variant}s)
        if(variant STREQUAL "near_miss")
            set(folder near_misses)
        endif()
        set(target ${short}.${name}.${variant})
        if(NOT EXISTS ${dir}/checks/${name}.cpp OR NOT EXISTS ${dir}/${folder}/${name}.hpp)
            continue()  # the test "every exercise is whole" tells
        endif()
        add_executable(${target} ${dir}/checks/${name}.cpp)
        target_include_directories(${target} PRIVATE ${dir}/${folder})
        target_link_libraries(${target} PRIVATE book_catch_main book_common book_flags)
        book_link_chapters(${target} ${chapter})
        set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/exercises)
        add_test(NAME ${target} COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D VARIANT=${variant}
                 -D "CATCH_ARGUMENTS=${BOOK_CATCH_ARGUMENTS}" -D FILE=${dir}/${folder}/${name}.hpp
                 -P ${PROJECT_SOURCE_DIR}/tests/house/exercise_verdict.cmake)
        set_tests_properties(${target} PROPERTIES LABELS exercise TIMEOUT 120)
        if(variant STREQUAL "exercise")
            set_tests_properties(${target} PROPERTIES SKIP_REGULAR_EXPRESSION "verdict: solved by a reader")
        endif()
    endforeach()
endfunction()

# add_book_test(name SOURCES a.cpp ... [LIBRARIES ...] [LABELS ...])
# A Catch2 program and a test that runs it; a program without test cases fails. Label no_sanitizer: left out of the
# sanitized runs of ./book test.
function(add_book_test name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES;LABELS" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE book_catch_main book_common book_flags ${ARG_LIBRARIES})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
    add_test(NAME ${name} COMMAND ${name} ${BOOK_CATCH_ARGUMENTS})
    set_tests_properties(${name} PROPERTIES LABELS "unit;${ARG_LABELS}" TIMEOUT 900)
endfunction()

# The lists that the command, the tests and the pages read: figures.json, exercises.txt, chapters.txt.
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
endfunction()
