/// @file
/// What the lab offers. A new chapter adds one line to one of the two lists.
#include "chapters/ch12_comparison/structures.hpp"

#include <tuple>

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"

namespace space {
namespace {

template <TriangleTest T>
struct NamedTest {
    using Test = T;
    std::string_view name, about;
};

// [triangle_tests]
constexpr std::tuple triangle_tests{
    NamedTest<MollerTrumbore>{"moller-trumbore", "Möller & Trumbore 1997, in double"},
    NamedTest<BasicMollerTrumbore<float>>{"moller-trumbore-float", "the same in float, which misses rays near edges"},
};
// [triangle_tests]

/// A structure with every triangle test.
template <template <TriangleTest> class A>
Structure offer(std::string_view name, std::string_view about) {
    const auto variant = [](const auto& test) {
        using Test = typename std::remove_cvref_t<decltype(test)>::Test;
        return StructureVariant{test.name, test.about, build_structure<A<Test>>};
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
