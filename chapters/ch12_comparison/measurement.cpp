#include "chapters/ch12_comparison/measurement.hpp"

#include "common/measure.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <new>
#include <utility>

namespace space {
namespace {

/// Does the work for a structure that stands; what it throws ends that structure, and frees it.
template <class Work>
void attempt(Measurement& measurement, BuiltStructure& built, const Work& work) {
    if (!measurement.stands()) return;
    try {
        work();
        return;
    } catch (const std::bad_alloc&) {
        measurement.gave_up = "out of memory";
    } catch (const std::exception& error) {
        measurement.gave_up = error.what();
    }
    built = {};
    measurement.hits = {};
}

std::vector<double> build_all(std::span<Measurement> measurements, const Geometry& geometry,
                              std::span<BuiltStructure> built, const LabOptions& options) {
    const std::size_t runs_each = static_cast<std::size_t>(options.repeat) + 1;  // one to warm up
    Progress progress("building", runs_each * measurements.size());
    std::vector<std::function<void()>> runs;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        Measurement& measurement = measurements[i];
        // The old structure is freed in a run of its own, so that no build is timed with it.
        runs.push_back([&built = built[i]] { built = {}; });
        runs.push_back([&, &built = built[i]] {
            attempt(measurement, built,
                    [&] { built = measurement.choice.variant->build(geometry, options.build); });
            progress.step();
        });
    }
    const std::vector<double> medians = interleaved_medians(runs, options.repeat);
    std::vector<double> times;
    for (std::size_t i = 0; i < measurements.size(); ++i) times.push_back(medians[2 * i + 1]);
    return times;
}

std::vector<double> trace_all(std::span<Measurement> measurements, std::span<const Ray> rays,
                              std::span<BuiltStructure> built, const LabOptions& options) {
    const std::size_t runs_each = static_cast<std::size_t>(options.repeat) + 1;
    Progress progress("tracing", runs_each * measurements.size() * rays.size());
    std::vector<std::function<void()>> runs;
    for (std::size_t i = 0; i < measurements.size(); ++i)
        // The first run, which warms up and is not timed, is the one that counts.
        runs.push_back(
            [&, &measurement = measurements[i], &built = built[i], first = true]() mutable {
                const bool counts = std::exchange(first, false);
                attempt(measurement, built, [&] {
                    const Batch batch{rays, measurement.hits, options.query, options.common.threads,
                                      &progress};
                    if (counts && built.count)
                        measurement.counts = built.count(batch);
                    else if (options.packets && built.trace_packets)
                        built.trace_packets(batch);
                    else
                        built.trace(batch);
                });
            });
    return interleaved_medians(runs, options.repeat);
}

}  // namespace

std::size_t Measurement::hit_count() const {
    return static_cast<std::size_t>(
        std::count_if(hits.begin(), hits.end(), [](auto& hit) { return hit.is_hit(); }));
}

std::vector<Measurement> measure(std::span<const Choice> chosen, const Geometry& geometry,
                                 std::span<const Ray> rays, const LabOptions& options,
                                 const std::function<void(const BuiltStructure&)>& look) {
    std::vector<Measurement> measurements;
    for (const Choice& choice : chosen) measurements.push_back({.choice = choice});
    std::vector<BuiltStructure> built(chosen.size());
    const std::vector<double> build_ms = build_all(measurements, geometry, built, options);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        attempt(measurements[i], built[i], [&] {
            measurements[i].build_threads = built[i].build_threads;
            measurements[i].configuration = built[i].configuration;
            measurements[i].hits.resize(rays.size());
        });
    const std::vector<double> trace_ms = trace_all(measurements, rays, built, options);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        // As the rays leave it: a lazy tree stands by then.
        attempt(measurements[i], built[i], [&] { measurements[i].shape = built[i].shape(); });
        measurements[i].build_ms = build_ms[i];
        measurements[i].trace_ms = trace_ms[i];
        if (measurements[i].stands()) look(built[i]);
    }
    return measurements;
}

}  // namespace space
