#include "chapters/ch03_bsp_trees/measured/measurements.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace space::ch03 {
namespace {

/// Corners anywhere in a cube: every plane cuts a good part of all triangles.
std::vector<Triangle> big_triangles(std::uint32_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point3 a = random_vector(random), b = random_vector(random),
                     c = random_vector(random);
        triangles.push_back({a, b, c});
    }
    return triangles;
}

/// One behind the other, the farthest first, each a little larger than the one before it.
std::vector<Triangle> stack(std::uint32_t count, std::uint64_t) {
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto z = static_cast<float>(i) / static_cast<float>(count), r = 1.0f + z;
        triangles.push_back({{-r, -r, z}, {r, -r, z}, {0.0f, r, z}});
    }
    return triangles;
}

template <const char* name>
std::vector<Triangle> named(std::uint32_t size, std::uint64_t seed) {
    return make_scene(fmt::format("{}:{}", name, size), seed).mesh.triangles();
}
constexpr char soup[] = "soup", boxes[] = "boxes", icosphere_scene[] = "icosphere";

/// From about 100 polygons to 100,000 in half decades, where they can be had.
struct GrowingScene {
    const char* name;
    std::vector<std::uint32_t> sizes;
    std::vector<Triangle> (*make)(std::uint32_t size, std::uint64_t seed);
};
const std::vector<GrowingScene>& growing_scenes() {
    static const std::vector<GrowingScene> scenes{
        {"soup", {100, 316, 1'000, 3'162, 10'000, 31'623, 100'000}, named<soup>},
        {"big triangles", {50, 100, 200, 400, 800}, big_triangles},
        {"boxes", {8, 26, 83, 263, 832, 2'635, 8'332}, named<boxes>},
        {"teapot",
         {1, 2, 3, 6, 11, 19, 34},
         [](std::uint32_t detail, std::uint64_t) { return teapot(detail).triangles(); }},
        {"icosphere", {2, 4, 7, 13, 22, 40, 71}, named<icosphere_scene>},
        {"stack", {100, 316, 1'000, 3'162, 10'000, 31'623, 100'000}, stack},
    };
    return scenes;
}

/// How many polygons are held against planes: once where they are placed, and for each candidate.
std::uint64_t classified(const Method& method, std::uint64_t placed) {
    const bool tries =
        method.splitter != SplitterChoice::first && method.splitter != SplitterChoice::random;
    return placed * (tries ? 1 + BspConfig{}.candidates : 1);
}

/// Placements of the next tree: as from the last two, at least linear; quadratic after one.
std::uint64_t next_placed(const std::vector<TreePoint>& points, std::size_t polygons) {
    const TreePoint& last = points.back();
    const auto exponent_between = [](const TreePoint& a, const TreePoint& b) {
        return std::log(double(b.placed) / double(a.placed)) /
               std::log(double(b.polygons) / double(a.polygons));
    };
    const double exponent =
        points.size() < 2 ? 2.0 : std::max(1.0, exponent_between(points.end()[-2], last));
    return static_cast<std::uint64_t>(double(last.placed) *
                                      std::pow(double(polygons) / double(last.polygons), exponent));
}

/// Adds the next tree to the series, or the reason why it ends here.
void grow(Growth& growth, const Method& method, const TreeTask& task, const Limits& limit) {
    if (!growth.points.empty()) {
        const auto work = classified(method, next_placed(growth.points, task.triangles.size()));
        if (work > limit.max_classified) {
            growth.stopped = fmt::format("{} would take {:.0f} million classifications",
                                         with_commas(task.triangles.size()), 1e-6 * double(work));
            return;
        }
    }
    try {
        growth.points.push_back(measure_tree(task, method, limit.max_fragments));
    } catch (const LimitError&) {
        growth.stopped =
            fmt::format("{} have more than {} fragments", with_commas(task.triangles.size()),
                        with_commas(limit.max_fragments));
    }
}

constexpr bool grows(const Method& method) {
    return method.straddlers == Straddlers::split;
}

}  // namespace

std::vector<Growth> measure_growth(const Options& options) {
    const Limits limit = limits(options.amount());
    std::vector<Growth> all;
    Progress progress("growth", growing_scenes().size() * limit.sizes * (methods.size() - 1));
    for (const GrowingScene& scene : growing_scenes()) {
        const std::size_t first = all.size(), sizes = std::min(limit.sizes, scene.sizes.size());
        for (const Method& method : methods)
            if (grows(method))
                all.push_back({.scene = scene.name, .method = std::string(method.name)});
        for (std::size_t i = 0; i < limit.sizes; ++i) {
            const auto stopped = [](const Growth& growth) { return !growth.stopped.empty(); };
            const bool ended =
                i >= sizes || std::all_of(&all[first], all.data() + all.size(), stopped);
            if (ended) {
                progress.step(methods.size() - 1);
                continue;
            }
            const TreeTask task(scene.name, scene.make(scene.sizes[i], options.seed), options);
            std::size_t series = first;
            for (const Method& method : methods) {
                if (!grows(method)) continue;
                Growth& growth = all[series++];
                if (growth.stopped.empty()) grow(growth, method, task, limit);
                progress.step();
            }
        }
    }
    return all;
}

}  // namespace space::ch03
