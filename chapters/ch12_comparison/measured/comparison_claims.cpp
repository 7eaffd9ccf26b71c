#include "chapters/ch12_comparison/measured/comparison_tables.hpp"
#include "chapters/ch12_comparison/measured/comparison_views.hpp"
#include "common/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace space::ch12 {

std::vector<ClaimAnswer> answer_comparison(const Comparison& comparison) {
    std::size_t agree = 0;
    std::vector<double> even, uneven;
    std::vector<std::string> scenes, against;
    for (const OctreeDuel& duel : octree_duels(comparison)) {
        (duel.is_even ? even : uneven).push_back(duel.ratio());
        if (duel.is_even) continue;
        scenes.push_back(duel.scene);
        agree += duel.ratio() > 1.0;
        if (duel.ratio() <= 1.0) against.push_back(duel.scene);
    }
    const std::size_t all = scenes.size();
    const std::string exceptions = against.empty() ? "" : ", not on " + joined(against);
    return {{"O14", verdict_of(agree, all),
             fmt::format("a BVH over bins is faster than the best of three octrees on {} of {} "
                         "uneven scenes{}; a ray costs {:.2f} times as much in the octree there, "
                         "{:.2f} times on even scenes (medians)",
                         agree, all, exceptions, median(std::move(uneven)),
                         even.empty() ? 0.0 : median(std::move(even))),
             joined(scenes),
             "confirmed: on every uneven scene a ray costs more in the best of chapter 6's octrees "
             "than in bvh-binned, the mean over camera, shadow, diffuse and any-hit rays"}};
}

}  // namespace space::ch12
