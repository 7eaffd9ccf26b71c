# What the project's CMakeLists.txt files are written in: one line per chapter, exercise, figure and test.

# Warnings are errors in our code; other people's headers are system headers. Floating point is never contracted or
# reordered: exact signs and equal results on every machine depend on it (DESIGN: accuracy).
add_library(book_flags INTERFACE)
target_compile_features(book_flags INTERFACE cxx_std_20)
target_compile_options(book_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror
                                            -ffp-contract=off)
target_include_directories(book_flags INTERFACE ${PROJECT_SOURCE_DIR})

# add_chapter(ch05_lazy_kd_trees [BUILDS_ON ch04_kd_trees ...])
# Builds chapters/<name>/{main,figures}.cpp (what there is) into the program <name>.
function(add_chapter name)
    cmake_parse_arguments(ARG "" "" "BUILDS_ON" ${ARGN})
    set(dir ${PROJECT_SOURCE_DIR}/chapters/${name})
    file(GLOB sources CONFIGURE_DEPENDS ${dir}/*.cpp)
    set_property(GLOBAL APPEND PROPERTY BOOK_CHAPTERS ${name})
    set_property(GLOBAL PROPERTY BOOK_${name}_BUILDS_ON ${ARG_BUILDS_ON})
    if(sources)
        add_executable(${name} ${sources})
        target_link_libraries(${name} PRIVATE book_common book_flags)
        set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
    endif()
endfunction()
