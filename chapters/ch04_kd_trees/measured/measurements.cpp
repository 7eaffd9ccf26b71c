#include "chapters/ch04_kd_trees/measured/measurements.hpp"

namespace space::ch04 {

Limits limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {.width = 32,
                    .height = 24,
                    .sizes = 3,
                    .rays = 200,
                    .aimed_rays = 1'000,
                    .rounds = 1};
        case Amount::quick:
            return {.width = 80,
                    .height = 60,
                    .sizes = 3,
                    .rays = 2'000,
                    .aimed_rays = 20'000,
                    .rounds = 3};
        default:
            return {.width = 240,
                    .height = 180,
                    .sizes = 7,
                    .rays = 10'000,
                    .aimed_rays = 200'000,
                    .rounds = options.counts ? 0 : 3};
    }
}

std::uint64_t wrong_answers(const Measurements& measured) {
    std::uint64_t wrong = 0;
    for (const PicturePoint& point : measured.pictures) wrong += point.other_pixels;
    for (const CurePoint& point : measured.cures)
        if (point.cure == all_cures || point.cure == other_tree) wrong += point.lost;
    for (const TreePoint& point : measured.trees)
        if (point.rule != sah_split) wrong += point.wrong;
    for (const Growth& growth : measured.growth)
        for (const TreePoint& point : growth) wrong += point.wrong;
    for (const PointSet& set : measured.points)
        for (const NearestQueries& queries : set.nearest) wrong += queries.wrong;
    for (const CarePoint& point : measured.care)
        if (point.care == care_names.back()) wrong += point.lost;
    for (const OverlapPoint& point : measured.overlaps) wrong += point.wrong;
    return wrong;
}

}  // namespace space::ch04
