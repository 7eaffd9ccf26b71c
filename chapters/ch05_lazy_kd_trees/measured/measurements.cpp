#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"

namespace space::ch05 {

Limits limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {.teapot = 3,
                    .plants = 2,
                    .width = 32,
                    .height = 24,
                    .rays = 300,
                    .field_cells = 256,
                    .ball_levels = 3,
                    .picture_levels = 3,
                    .list_sizes = 2,
                    .rounds = 1};
        case Amount::quick:
            return {.teapot = 30,
                    .plants = 8,
                    .width = 320,
                    .height = 240,
                    .rays = 20'000,
                    .field_cells = 1'024,
                    .ball_levels = 4,
                    .picture_levels = 4,
                    .list_sizes = 3,
                    .rounds = 1};
        default:
            return {.teapot = 60,
                    .plants = 18,
                    .width = 640,
                    .height = 480,
                    .rays = 100'000,
                    .field_cells = 4'096,
                    .ball_levels = 5,
                    .picture_levels = 5,
                    .list_sizes = 4,
                    .rounds = options.counts ? 0 : 3};
    }
}

std::uint64_t wrong_answers(const Measurements& measured) {
    std::uint64_t wrong = 0;
    for (const ViewPoint& point : measured.views) wrong += point.other_pixels;
    for (const ReachPoint& point : measured.reach) wrong += point.different;
    for (const ListPoint& point : measured.lists) wrong += point.different;
    for (const GeometryPoint& point : measured.geometry) wrong += point.different.value_or(0);
    return wrong;
}

}  // namespace space::ch05
