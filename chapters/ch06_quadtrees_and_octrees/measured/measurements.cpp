#include "chapters/ch06_quadtrees_and_octrees/measured/measurements.hpp"

#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"

namespace space::ch06 {

Limits limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {.rays = 200,
                    .most_triangles = 1'500,
                    .most_points = 10'000,
                    .queries = 200,
                    .rounds = 0};
        case Amount::quick:
            return {.rays = 2'000,
                    .most_triangles = 20'000,
                    .most_points = 100'000,
                    .queries = 2'000,
                    .rounds = 3};
        default:
            return {.rays = 5'000,
                    .most_triangles = options.quick ? 20'000u : 1'000'000u,
                    .most_points = options.quick ? 100'000u : 1'000'000u,
                    .queries = 5'000,
                    .rounds = options.counts ? 0 : 3};
    }
}

std::uint64_t wrong_answers(const Measurements& measured) {
    std::uint64_t wrong = wrong_answers(measured.adaptive);
    for (const auto* trees : {&measured.trees, &measured.growth, &measured.depths})
        for (const TreePoint& point : *trees) wrong += point.wrong;
    for (const SearchPoint& point : measured.searches) wrong += point.differs;
    return wrong;
}

}  // namespace space::ch06
