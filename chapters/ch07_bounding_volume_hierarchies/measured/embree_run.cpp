#include "chapters/ch07_bounding_volume_hierarchies/measured/embree_run.hpp"

#ifdef BOOK_HAS_EMBREE
#include "common/embree_tree.hpp"

#include <string_view>
#include <utility>
#endif

namespace space::ch07 {

#ifdef BOOK_HAS_EMBREE

std::vector<PeerRun> embree_runs(const RayTask& task) {
    std::vector<PeerRun> all;
    constexpr std::pair<std::string_view, RTCBuildQuality> qualities[]{
        {embree, RTC_BUILD_QUALITY_MEDIUM}, {embree_high, RTC_BUILD_QUALITY_HIGH}};
    for (const auto& [name, quality] : qualities) {
        const auto build = [&task, flavour = EmbreeFlavour{.quality = quality}] {
            return std::make_shared<const EmbreeTree>(task.triangles, 1, flavour);
        };
        PeerRun run{.point = {.scene = task.scene, .builder = name, .n = task.triangles.size()},
                    .build = [build] { do_not_optimize(build()); },
                    .traces = {}};
        Stopwatch stopwatch;
        const auto tree = build();
        run.point.build_ms = stopwatch.lap().count();
        run.point.bytes = tree->shape().bytes;
        run.point.references = tree->shape().references;
        run.traces = runs<DenormalsAreZero>(task, tree);
        all.push_back(std::move(run));
    }
    return all;
}

#else

std::vector<PeerRun> embree_runs(const RayTask&) {
    return {};
}

#endif

}  // namespace space::ch07
