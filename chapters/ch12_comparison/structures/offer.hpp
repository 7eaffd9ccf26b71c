/// @file
/// What the files in this folder are written in: a structure with each of the lab's triangle tests.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch02_intersection_tests/named_test.hpp"
#include "chapters/ch02_intersection_tests/watertight.hpp"
#include "chapters/ch12_comparison/structures.hpp"

#include <string_view>
#include <tuple>
#include <vector>

namespace space {

// [lab_tests]
/// Three of chapter 2's eight: the reference, with which every structure must answer as exact
/// arithmetic does; what most programs do; and the best of those that are not exact. Each more is
/// compiled into every structure of the book.
inline constexpr std::tuple lab_tests{
    NamedTest<FilteredExact>{"filtered-exact", "always the decision of exact arithmetic"},
    NamedTest<MollerTrumboreFloat>{"moller-trumbore-float",
                                   "what most programs do: Möller & Trumbore 1997, in float"},
    NamedTest<Watertight>{"watertight",
                          "no ray slips through a shared edge (Woop, Benthin & Wald 2013)"},
};
// [lab_tests]

/// Those that are compiled. Under sanitizers the suite takes each structure through all three, and
/// the lab need not.
#ifdef BOOK_SANITIZED
inline constexpr std::tuple offered_tests{std::get<0>(lab_tests)};
#else
inline constexpr std::tuple offered_tests = lab_tests;
#endif

/// A structure with each of these tests; `builder(test)` gives what builds it.
template <class Builder>
Structure offer_with(std::string_view name, std::string_view about, const Builder& builder) {
    return {
        .name = name,
        .about = about,
        .variants = std::apply(
            [&](const auto&... tests) {
                return std::vector{StructureVariant{tests.name, tests.about, builder(tests)}...};
            },
            offered_tests)};
}

/// The same of a structure by its type; `configure(config, limits)` may change what its Config has
/// by default.
template <template <TriangleTest> class A, class Configure>
Structure offer(std::string_view name, std::string_view about, const Configure& configure) {
    return offer_with(name, about, [&](const auto& test) {
        using Built = A<TestOf<decltype(test)>>;
        return [configure](std::span<const Triangle> triangles, const BuildOptions& options) {
            typename Built::Config config;
            configure(config, options.limits);
            return build_configured<Built>(triangles, options, config);
        };
    });
}
template <template <TriangleTest> class A>
Structure offer(std::string_view name, std::string_view about) {
    return offer<A>(name, about, [](auto&, const Limits&) {});
}

}  // namespace space
