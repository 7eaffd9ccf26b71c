/// @file
/// The box and sphere tests of the chapter by name, for loops over all of them.
#pragma once

#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "chapters/ch02_intersection_tests/named_test.hpp"
#include "chapters/ch02_intersection_tests/spheres.hpp"

namespace space {

inline constexpr std::tuple box_tests{
    NamedTest<SlabBranching>{"branching", "a branch at every step, three divisions"},
    NamedTest<SlabMinMax>{"min/max", "no branch until the end, three divisions"},
    NamedTest<SlabReciprocal>{"reciprocal", "the same with 1 / d, made once per ray (Optim25)"},
    NamedTest<SlabSafe>{"safe",
                        "the side of entry by the sign of 1 / d; keeps its interval against NaN"},
    NamedTest<SlabConservative>{"conservative",
                                "safe, and widened by a derived bound: never misses"},
    NamedTest<SlabAsPrinted>{"as printed", "Optim25's, which rejects rays from inside"},
};
inline constexpr std::size_t box_test_count = std::tuple_size_v<decltype(box_tests)>;

inline constexpr std::tuple sphere_tests{
    NamedTest<SphereAsPrinted>{"as printed", "the line's distance from the centre (Heinonen16)"},
    NamedTest<SphereSchoolbook>{"schoolbook", "the quadratic as at school"},
    NamedTest<SphereStable>{"stable", "discriminant from the nearest point (Haines et al. 2019)"},
    NamedTest<SphereDouble>{"double", "the schoolbook's in double"},
};
inline constexpr std::size_t sphere_test_count = std::tuple_size_v<decltype(sphere_tests)>;

}  // namespace space
