/// @file
/// What the lab offers: every structure with every triangle test of chapter 2. A new chapter adds
/// one line to the list.
#include "chapters/ch12_comparison/structures.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "chapters/ch03_bsp_trees/bsp.hpp"

#include <tuple>

namespace space {
namespace {

/// A structure with every triangle test; `configure` may change what its Config has by default.
template <template <TriangleTest> class A, class Configure>
Structure offer(std::string_view name, std::string_view about, const Configure& configure) {
    const auto variant = [&](const auto& test) {
        using Structure = A<TestOf<decltype(test)>>;
        return StructureVariant{test.name, test.about,
                                [configure](std::span<const Triangle> triangles, unsigned threads) {
                                    typename Structure::Config config;
                                    configure(config);
                                    return build_configured<Structure>(triangles, threads, config);
                                }};
    };
    return {name, about,
            std::apply([&](const auto&... tests) { return std::vector{variant(tests)...}; },
                       triangle_tests)};
}
template <template <TriangleTest> class A>
Structure offer(std::string_view name, std::string_view about) {
    return offer<A>(name, about, [](auto&) {});
}

/// BSP trees outgrow memory on scenes that cut each other often, and patience on convex ones. Some
/// 3 GB and a minute.
constexpr std::size_t max_fragments = 10'000'000;
constexpr std::uint64_t max_placed = 100'000'000;

Structure offer_bsp(std::string_view name, std::string_view about, SplitterChoice splitter,
                    Straddlers straddlers = Straddlers::split) {
    return offer<Bsp>(name, about, [=](BspConfig& config) {
        config.splitter = splitter;
        config.straddlers = straddlers;
        config.max_fragments = max_fragments;
        config.max_placed = max_placed;
    });
}

}  // namespace

// [structures]
const std::vector<Structure>& structures() {
    static const std::vector<Structure> all{
        offer<Naive>("naive",
                     "no structure: every ray is tested against every triangle (chapter 1)"),
        offer_bsp("bsp", "BSP tree; planes weighed by balance and cuts (chapter 3)",
                  SplitterChoice::weighted),
        offer_bsp("bsp-first", "the same; the plane of the first polygon", SplitterChoice::first),
        offer_bsp("bsp-random", "the same; the plane of any polygon", SplitterChoice::random),
        offer_bsp("bsp-balanced", "the same; as many polygons in front as behind",
                  SplitterChoice::balanced),
        offer_bsp("bsp-fewest", "the same; the fewest cuts", SplitterChoice::fewest_splits),
        offer_bsp("bsp-shared", "as bsp; a polygon that would be cut goes whole to both sides",
                  SplitterChoice::weighted, Straddlers::share),
        offer_bsp("bsp-free", "as bsp; planes across an axis where polygons' planes are lopsided",
                  SplitterChoice::free),
    };
    return all;
}
// [structures]

}  // namespace space
