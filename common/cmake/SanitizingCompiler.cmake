# Included before project(): for memory and undefined behaviour clang compiles in half of g++'s time. It must be one that
# reads GCC's ranges (16 or later) and has its sanitizers, a package of their own; else, or where CXX says so, g++ does it.
if(BOOK_SANITIZE MATCHES address AND NOT CMAKE_CXX_COMPILER AND NOT DEFINED ENV{CXX})
    find_program(BOOK_CLANG NAMES clang++-19 clang++)
    set(BOOK_WITHOUT_CLANG "it is not installed")
    if(BOOK_CLANG)
        file(WRITE ${CMAKE_BINARY_DIR}/sanitized.cpp "#include <ranges>
int main() {
    for (int i : std::views::iota(0, 2) | std::views::filter([](int j) { return j > 0; })) return i - 1;
}\n")
        execute_process(COMMAND ${BOOK_CLANG} -std=c++20 -fsanitize=${BOOK_SANITIZE} sanitized.cpp -o sanitized
                        WORKING_DIRECTORY ${CMAKE_BINARY_DIR} RESULT_VARIABLE BOOK_WITHOUT_CLANG OUTPUT_QUIET ERROR_QUIET)
    endif()
    if(NOT BOOK_WITHOUT_CLANG)
        set(CMAKE_CXX_COMPILER ${BOOK_CLANG} CACHE FILEPATH "C++ compiler")
    endif()
endif()
