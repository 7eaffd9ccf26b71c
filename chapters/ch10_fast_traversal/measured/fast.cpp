#include "chapters/ch10_fast_traversal/measured/fast.hpp"

#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "common/program/progress.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch10 {
namespace {

/// Not on the ladder, but where most is lost: its rays' work is looked at, too.
constexpr std::string_view hardest_scene = "slivers";

/// Every fourth of its rays, which take long.
TracedScene thinned(TracedScene scene) {
    for (std::vector<Ray>& rays : scene.rays) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < rays.size(); i += 4) rays[kept++] = rays[i];
        rays.resize(kept);
    }
    return scene;
}

bool is_among(const std::vector<FastScene>& scenes, const std::string& name) {
    return std::ranges::any_of(scenes, [&](const FastScene& s) { return s.name == name; });
}

}  // namespace

FastMeasurements measure_fast(const Options& options) {
    const FastEffort effort = fast_effort(options);
    FastMeasurements measured;
    if (options.counts && options.quick) {  // what takes seconds
        measure_aimed(options, measured);
        return measured;
    }
    measure_probes(effort, measured);
    std::vector<FastScene> all = effort.ladder;
    for (const FastScene& scene : effort.scenes)
        if (!is_among(all, scene.name)) all.push_back(scene);
    Progress progress("scenes", all.size());
    for (const auto& [name, is_long] : all) {
        if (const std::optional<TracedScene> scene =
                traced_scene(name, is_long, effort.width, effort.height, options)) {
            if (is_among(effort.ladder, name)) {
                measure_work(*scene, effort, measured);
                measure_choices(*scene, effort, measured);
                measure_cures(*scene, effort, measured);
                measure_ladder(*scene, options, measured);
            }
            if (name == hardest_scene) measure_work(thinned(*scene), effort, measured);
            if (is_among(effort.scenes, name)) measure_peers(*scene, options, measured);
        }
        progress.step();
    }
    for (const auto& [name, is_long] : effort.modes)
        if (const std::optional<TracedScene> scene =
                traced_scene(name, is_long, effort.mode_width, effort.mode_height, options))
            measure_modes(*scene, effort, measured);
    measure_sizes(options, measured);
    measure_aimed(options, measured);
    return measured;
}

std::uint64_t wrong_answers(const FastMeasurements& measured) {
    std::uint64_t wrong = 0;
    for (const PeerPoint& p : measured.peers) wrong += p.differ;
    for (const ModePoint& p : measured.modes) wrong += p.differ;
    for (const KernelPoint& p : measured.kernels) wrong += p.differ;
    for (const AimedPoint& p : measured.aimed) wrong += p.tracer.starts_with("ours") ? p.wrong : 0;
    return wrong;
}

}  // namespace space::ch10
