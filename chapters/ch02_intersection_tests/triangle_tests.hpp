/// @file
/// Every ray-triangle test of the book by name: for loops over all of them, and for
/// --triangle-test.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/lichter.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch02_intersection_tests/named_test.hpp"
#include "chapters/ch02_intersection_tests/plucker.hpp"
#include "chapters/ch02_intersection_tests/unit_triangle.hpp"
#include "chapters/ch02_intersection_tests/watertight.hpp"

namespace space {

// [triangle_tests]
inline constexpr std::tuple triangle_tests{
    NamedTest<MollerTrumbore>{"moller-trumbore", "Möller & Trumbore 1997, in double (chapter 1)"},
    NamedTest<MollerTrumboreFloat>{"moller-trumbore-float", "the same in float"},
    NamedTest<LichterFirst>{"lichter-first",
                            "plane and edge signs, three square roots (Lichter23)"},
    NamedTest<LichterImproved>{"lichter-improved", "the same with early exit and two square roots"},
    NamedTest<UnitTriangle>{"unit-triangle", "an affine map made once per triangle (Woop 2004)"},
    NamedTest<Plucker>{"plucker", "signed volumes, exact opposites at shared edges"},
    NamedTest<Watertight>{"watertight", "shear made once per ray (Woop, Benthin & Wald 2013)"},
    NamedTest<FilteredExact>{"filtered-exact", "always the decision of exact arithmetic"},
};
// [triangle_tests]
inline constexpr std::size_t triangle_test_count = std::tuple_size_v<decltype(triangle_tests)>;

}  // namespace space
