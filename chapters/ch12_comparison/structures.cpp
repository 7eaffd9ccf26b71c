/// @file
/// What the lab offers: every structure with every triangle test of chapter 2. A new chapter adds one line to the list.
#include "chapters/ch12_comparison/structures.hpp"

#include <tuple>

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"

namespace space {
namespace {

/// A structure with every triangle test.
template <template <TriangleTest> class A>
Structure offer(std::string_view name, std::string_view about) {
    const auto variant = [](const auto& test) {
        return StructureVariant{test.name, test.about, build_structure<A<TestOf<decltype(test)>>>};
    };
    return {name, about,
            std::apply([&](const auto&... tests) { return std::vector{variant(tests)...}; }, triangle_tests)};
}

}  // namespace

// [structures]
const std::vector<Structure>& structures() {
    static const std::vector<Structure> all{
        offer<Naive>("naive", "no structure: every ray is tested against every triangle (chapter 1)"),
    };
    return all;
}
// [structures]

}  // namespace space
