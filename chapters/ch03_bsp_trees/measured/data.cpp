#include "chapters/ch03_bsp_trees/measured/data.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace space::ch03 {

const Growth& growth_of(const std::vector<Growth>& growths, std::string_view scene,
                        std::string_view method) {
    for (const Growth& growth : growths)
        if (growth.scene == scene && growth.method == method) return growth;
    throw std::out_of_range(fmt::format("no growth of {} by {}", scene, method));
}

std::uint64_t wrong_answers(const Measurements& measured) {
    std::uint64_t wrong = 0;
    for (const TreePoint& point : measured.methods.trees) wrong += point.wrong;
    for (const TreePoint& point : measured.scenes) wrong += point.wrong;
    for (const Growth& growth : measured.growth)
        for (const TreePoint& point : growth.points) wrong += point.wrong;
    for (const Crossings& crossings : measured.crossings) wrong += crossings.contradicted;
    for (const GradePoint& point : measured.grades)
        if (point.grade == "exact")
            wrong +=
                (point.area_error != 0.0) + point.cracks + point.edge_slipped + point.cut_slipped;
    return wrong;
}

Crossings all_crossings(const Measurements& measured) {
    Crossings sum{.scene = "all"};
    for (const Crossings& crossings : measured.crossings) sum += crossings;
    return sum;
}

std::uint64_t checked_rays(const Measurements& measured) {
    std::uint64_t rays = 0;
    for (const auto* points : {&measured.methods.trees, &measured.scenes})
        for (const TreePoint& point : *points) rays += point.rays;
    for (const Growth& growth : measured.growth)
        for (const TreePoint& point : growth.points) rays += point.rays;
    return rays;
}

}  // namespace space::ch03
