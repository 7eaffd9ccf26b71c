#include "tests/ch08/parallel_builders.hpp"

#include "chapters/ch08_parallel_builds/asymmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/endings.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"

#include <mutex>
#include <utility>

namespace space {
namespace {

/// configure(config) sets what is the builder's own.
template <class Builder, class Configure>
ParallelBuilder with(std::string name, const Configure& configure) {
    return {std::move(name),
            [=](std::span<const Triangle> triangles, const BinnedBuilder::Config& binned,
                unsigned threads, Watcher& watcher) {
                typename Builder::Config config;
                static_cast<BinnedBuilder::Config&>(config) = binned;
                config.threads = threads;
                configure(config);
                return Builder::template build<3>(triangles, config, watcher);
            }};
}
template <class Builder>
ParallelBuilder with(std::string name) {
    return with<Builder>(std::move(name), [](auto&) {});
}

}  // namespace

std::vector<ParallelBuilder> parallel_builders() {
    std::vector<ParallelBuilder> all;
    all.push_back(with<AsymmetricBuilder>("asymmetric"));
    all.push_back(with<SymmetricBuilder>("symmetric"));
    const std::pair<const char*, QueueCondition> conditions[] = {
        {"queue (1)", QueueCondition::threads},
        {"queue (2)", QueueCondition::twice_threads},
        {"queue (3)", QueueCondition::threads_to_threads},
        {"queue (4)", QueueCondition::depth},
        {"queue", QueueCondition::combined}};
    for (const auto& [name, condition] : conditions)
        all.push_back(with<QueueBuilder>(
            name, [condition](QueueBuilder::Config& config) { config.condition = condition; }));
    all.push_back(with<BasicQueueBuilder<PollFlags, std::mutex>>("queue that polls"));
    all.push_back(with<BasicQueueBuilder<QuitWhenEmpty, std::mutex>>("queue whose workers quit"));
    all.push_back(with<WorkStealingBuilder>("work stealing"));
    using Config = WorkStealingBuilder::Config;
    all.push_back(with<WorkStealingBuilder>("work stealing, small limits", [](Config& config) {
        config.large = 40, config.chunk = 7, config.grain = 3;
    }));
    all.push_back(with<WorkStealingBuilder>("work stealing, all nodes large", [](Config& config) {
        config.large = 0, config.chunk = 0, config.grain = 0;
    }));
    return all;
}

}  // namespace space
