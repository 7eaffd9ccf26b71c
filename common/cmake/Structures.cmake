# splitting_space::structures: the book's structures in a program of one's own. Headers, what they have in .cpp files, and
# the libraries that these need; nothing that draws, measures or tests. docs/own_program/ is an example, and the page "The
# code in your own program" says more.

# Answers depend on how floats are rounded. Contracted to fused multiply-adds, expressions are no longer what the error
# bounds of the tests and the margins of the boxes were proved for; GCC 12 at -O2 also drops roundings to float where its SLP
# vectoriser meets double -> float -> double (tests/house/rounding.cpp). So these go to all that compiles our headers.
set(SPACE_ARITHMETIC -ffp-contract=off $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

# space_kernel_options(target)
# For chapter 10's kernels among the target's sources: one text, compiled once for each instruction set. What a file has
# inline belongs to the file (ch10.symbols). (GCC 12 warns of its own intrinsics: they take what is never read.)
function(space_kernel_options target)
    set(kernels ${PROJECT_SOURCE_DIR}/chapters/ch10_fast_traversal/kernels)
    set(flags $<$<NOT:$<CONFIG:Debug>>:-O3> -Wno-psabi -Wno-pedantic -Wno-maybe-uninitialized)
    set(options_portable)
    set(options_sse2 -msse2)
    set(options_avx2 -mavx2 -mfma -mbmi -mbmi2 -mlzcnt -mpopcnt)
    set(options_avx512 ${options_avx2} -mavx512f -mavx512vl -mavx512dq -mavx512bw -mprefer-vector-width=256)
    foreach(set IN ITEMS portable sse2 avx2 avx512)
        if(set STREQUAL "portable" OR CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
            set_source_files_properties(${kernels}/kernel_${set}.cpp TARGET_DIRECTORY ${target} PROPERTIES
                SKIP_PRECOMPILE_HEADERS ON COMPILE_OPTIONS "${flags};${options_${set}}")
        else()
            set_source_files_properties(${kernels}/kernel_${set}.cpp TARGET_DIRECTORY ${target} PROPERTIES
                HEADER_FILE_ONLY ON)
        endif()
    endforeach()
endfunction()

if(PROJECT_IS_TOP_LEVEL)
    return()  # the book's own programs link its chapters
endif()

# Found for the whole program: who links the structures names them, too.
find_package(glm REQUIRED GLOBAL)
find_package(Threads REQUIRED GLOBAL)
set(chapters ${PROJECT_SOURCE_DIR}/chapters)
file(GLOB kernels CONFIGURE_DEPENDS ${chapters}/ch10_fast_traversal/kernels/*.cpp)
add_library(space_structures STATIC
    ${chapters}/ch09_instancing_and_motion/instanced_trees.cpp ${chapters}/ch09_instancing_and_motion/scene_graph.cpp
    ${chapters}/ch10_fast_traversal/instruction_set.cpp ${kernels})
add_library(splitting_space::structures ALIAS space_structures)
space_kernel_options(space_structures)
target_compile_features(space_structures PUBLIC cxx_std_20)
target_include_directories(space_structures PRIVATE ${PROJECT_SOURCE_DIR})
target_include_directories(space_structures SYSTEM INTERFACE ${PROJECT_SOURCE_DIR})  # others have other warnings
# A whole program may be compiled with -ffast-math; what includes our headers is not. (When it links, that flag would set
# denormal numbers to zero.)
target_compile_options(space_structures PUBLIC -fno-fast-math ${SPACE_ARITHMETIC})
target_link_options(space_structures INTERFACE -fno-fast-math)
target_link_libraries(space_structures PUBLIC glm::glm Threads::Threads)

find_library(GMP_LIBRARY gmp)
find_library(GMPXX_LIBRARY gmpxx)
if(GMP_LIBRARY AND GMPXX_LIBRARY)
    target_sources(space_structures PRIVATE ${chapters}/ch03_bsp_trees/exact_corner.cpp
                                            ${PROJECT_SOURCE_DIR}/common/zero_area.cpp)
    target_link_libraries(space_structures PUBLIC ${GMPXX_LIBRARY} ${GMP_LIBRARY})
else()
    message(STATUS "splitting_space: without chapter 3's BSP trees, for which GMP is missing (package libgmp-dev)")
endif()
find_package(TBB QUIET GLOBAL)
if(TBB_FOUND)
    target_sources(space_structures PRIVATE ${chapters}/ch08_parallel_builds/work_stealing.cpp)
    target_link_libraries(space_structures PUBLIC TBB::tbb)
else()
    message(STATUS "splitting_space: without chapter 8's work stealing, for which oneTBB is missing (package libtbb-dev)")
endif()
