#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"

namespace space::ch07 {

Limits limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {.width = 24,
                    .height = 18,
                    .most_triangles = 3'500,
                    .aimed_rays = 1'000,
                    .naive_tests = 200'000,
                    .rounds = 0};
        case Amount::quick:
            return {.width = 80,
                    .height = 60,
                    .most_triangles = 40'000,
                    .aimed_rays = 10'000,
                    .naive_tests = 3'000'000,
                    .rounds = 3};
        default:
            return {.width = 160,
                    .height = 120,
                    .most_triangles = 2'200'000,
                    .aimed_rays = 50'000,
                    .naive_tests = 30'000'000,
                    .rounds = options.counts ? 0 : 3};
    }
}

std::uint64_t wrong_answers(const TreeMeasurements& measured) {
    std::uint64_t wrong = 0;
    for (const auto* trees : {&measured.trees, &measured.growth})
        for (const TreePoint& point : *trees) wrong += point.wrong;
    for (const AccuracyPoint& point : measured.accuracy)
        if (point.margins == conservative && point.test == exact_test)
            wrong += point.wrong + point.other;
    for (const ExactPoint& point : measured.exact) wrong += point.wrong;
    return wrong;
}

}  // namespace space::ch07
