#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/sampled_scene.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <string_view>
#include <vector>

namespace space::ch06 {

std::vector<std::uint32_t> objects_of(const TriangleMesh& mesh) {
    std::vector<std::uint32_t> first(mesh.vertices.size());  // towards an object's least vertex
    std::iota(first.begin(), first.end(), 0u);
    const auto object = [&](std::uint32_t vertex) {
        while (first[vertex] != vertex) vertex = first[vertex] = first[first[vertex]];
        return vertex;
    };
    for (const auto& [a, b, c] : mesh.faces) {
        const std::uint32_t least = std::min({object(a), object(b), object(c)});
        for (const std::uint32_t vertex : {a, b, c}) first[object(vertex)] = least;
    }
    std::vector<std::uint32_t> objects;
    for (const auto& face : mesh.faces) objects.push_back(object(face[0]));
    return objects;
}

namespace {

struct AdaptiveLimits {
    std::vector<std::string_view> scenes;
    int width, height, rounds;
};
AdaptiveLimits adaptive_limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {.scenes = {"room:2", "lattice:2"}, .width = 96, .height = 72, .rounds = 0};
        case Amount::quick:
            return {.scenes = {"room", "lattice", "sphereflake"},
                    .width = 320,
                    .height = 240,
                    .rounds = 1};
        default:
            return {.scenes = {"room", "building", "sphereflake", "lattice", "tree", "mount"},
                    .width = 640,
                    .height = 480,
                    .rounds = options.counts ? 0 : 3};
    }
}

/// One way to sample a picture.
struct Way {
    std::string_view rule;
    AdaptiveConfig config;
};
/// Other thresholds and first cells are for one scene: the tables show no others.
std::vector<Way> ways(bool with_others) {
    using Evidence = AdaptiveConfig::Evidence;
    std::vector<Way> all;
    for (const int threshold : {2, 4, AdaptivePoint::usual_threshold, 16, 32}) {
        if (!with_others && threshold != AdaptivePoint::usual_threshold) continue;
        const AdaptiveConfig config{.threshold = threshold,
                                    .first_cell = AdaptivePoint::usual_first_cell};
        AdaptiveConfig corners = config, colors = config;
        corners.evidence = colors.evidence = Evidence::corners;
        colors.compare_surfaces = false;
        all.insert(all.end(),
                   {{by_colors, colors}, {by_objects, corners}, {by_all_samples, config}});
    }
    const AdaptiveConfig usual{.threshold = AdaptivePoint::usual_threshold,
                               .first_cell = AdaptivePoint::usual_first_cell};
    all.push_back({by_triangles, usual});
    if (!with_others) return all;
    for (const int first_cell : {2, 4, 8, 32, 64}) {
        AdaptiveConfig all_samples = usual;
        all_samples.first_cell = first_cell;
        AdaptiveConfig corners = all_samples;
        corners.evidence = Evidence::corners;
        all.insert(all.end(), {{by_objects, corners}, {by_all_samples, all_samples}});
    }
    return all;
}

AdaptivePicture sampled(const SampledScene& scene, const Way& way) {
    return way.rule == by_triangles ? scene.by_triangles(way.config) : scene.by_objects(way.config);
}

AdaptivePoint compare(const SampledScene& scene, const Way& way, const Image& full) {
    const AdaptivePicture picture = sampled(scene, way);
    AdaptivePoint point{.scene = scene.name(),
                        .rule = way.rule,
                        .threshold = way.config.threshold,
                        .first_cell = way.config.first_cell,
                        .pixels = picture.traced.size(),
                        .rays = picture.rays,
                        .cells = picture.cells.size()};
    const std::vector<std::uint8_t> is = srgb_bytes(picture.image), should = srgb_bytes(full);
    for (std::size_t pixel = 0; pixel < picture.traced.size(); ++pixel) {
        int off = 0;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
            off = std::max(off, std::abs(int{is[i]} - int{should[i]}));
        point.other += off > 0;
        point.wrong += off > AdaptivePoint::visible_steps;
        point.largest = std::max(point.largest, off);
        const int x = int(pixel) % full.width(), y = int(pixel) / full.width();
        point.different += picture.traced[pixel] && picture.image.at(x, y) != full.at(x, y);
    }
    return point;
}

/// All ways in turn with the full picture, on one thread; with other first cells none.
void time_ways(const SampledScene& scene, const std::vector<Way>& tried, int rounds,
               std::span<AdaptivePoint> points) {
    std::vector<std::function<void()>> candidates{[&] { do_not_optimize(scene.full()); }};
    std::vector<AdaptivePoint*> timed;
    for (std::size_t i = 0; i < tried.size(); ++i) {
        if (tried[i].config.first_cell != AdaptivePoint::usual_first_cell) continue;
        candidates.push_back([&, i] { do_not_optimize(sampled(scene, tried[i])); });
        timed.push_back(&points[i]);
    }
    const std::vector<double> medians = interleaved_medians(candidates, rounds);
    for (std::size_t i = 0; i < timed.size(); ++i) {
        timed[i]->full_ms = medians[0];
        timed[i]->ms = medians[i + 1];
    }
}

}  // namespace

std::vector<AdaptivePoint> measure_adaptive(const Options& options) {
    const AdaptiveLimits limit = adaptive_limits(options);
    std::vector<AdaptivePoint> points;
    Progress progress("adaptive sampling", limit.scenes.size());
    for (const std::string_view spec : limit.scenes) {
        const SampledScene scene(make_scene(spec, options.seed), limit.width, limit.height);
        const Image full = scene.full();
        const std::vector<Way> tried = ways(spec == limit.scenes.front());
        const std::size_t first = points.size();
        for (const Way& way : tried) points.push_back(compare(scene, way, full));
        if (limit.rounds > 0)
            time_ways(scene, tried, limit.rounds, std::span(points).subspan(first));
        progress.step();
    }
    return points;
}

std::uint64_t wrong_answers(const std::vector<AdaptivePoint>& points) {
    std::uint64_t wrong = 0;
    for (const AdaptivePoint& point : points) wrong += point.different;
    return wrong;
}

}  // namespace space::ch06
