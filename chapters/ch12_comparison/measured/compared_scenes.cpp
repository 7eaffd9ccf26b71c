#include "chapters/ch12_comparison/measured/compared_scenes.hpp"

#include "chapters/ch09_instancing_and_motion/nested_scenes.hpp"
#include "common/random_rays.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace space::ch12 {
namespace {

constexpr std::uint64_t any_size = ~std::uint64_t{0};

bool is_from_file(const ComparedScene& scene) {
    return scene.specs.size() == 1;
}

bool is_there(const std::string& spec) {
    return std::filesystem::exists(scene_file(spec));
}

}  // namespace

std::span<const ComparedScene> compared_scenes() {
    static const std::vector<ComparedScene> all = {
        {"scan", "scanned", true, {"scan:7", "scan:22", "scan:71", "scan:224"}},
        {"building", "architecture", false, {"building:1", "building:4", "building:40"}},
        {"tree", "plants", false, {"tree:4", "tree:7", "tree:10", "tree:14"}},
        {"mount", "terrain", true, {"mount:4", "mount:6", "mount:8"}},
        {"soup",
         "soup",
         true,
         {"soup:1000", "soup:10000", "soup:100000", "soup:1000000", "soup:2000000"}},
        {"slivers", "slivers", false, {"slivers:1000", "slivers:3000", "slivers:40000"}, 4},
        {"stadium", "teapot in a stadium", false, {"stadium:2", "stadium:10", "stadium:34"}},
        {"lattice", "lattice", true, {"lattice:1", "lattice:3", "lattice:7"}},
        {"shells", "overlapping shells", false, {"shells:1", "shells:3"}},
        {"soup_uneven",
         "all scales",
         false,
         {"soup_uneven:1000", "soup_uneven:10000", "soup_uneven:100000"}},
        {"boxes", "axis-aligned", true, {"boxes:80", "boxes:830", "boxes:8300"}},
        {"blanket",
         "one huge among small",
         false,
         {"blanket:1000", "blanket:10000", "blanket:100000"}},
        {"dust", "dust", true, {"dust:1000", "dust:10000", "dust:100000"}},
        {"tetra", "mostly empty", false, {"tetra:5", "tetra:7", "tetra:8"}},
        {"jacks", "instanced", false, {"graph/jacks:1", "graph/jacks:2", "graph/jacks:3"}},
        {"bunny", "scanned, from a file", true, {"bunny"}},
        {"dragon", "scanned, from a file", true, {"dragon_871k"}},
        {"conference", "architecture, from a file", false, {"conference"}},
        {"forest", "plants, from a file", false, {"forest"}},
    };
    return all;
}

const ComparedScene& compared_scene(std::string_view name) {
    const auto found = std::ranges::find(compared_scenes(), name, &ComparedScene::name);
    if (found == compared_scenes().end())
        throw std::out_of_range(fmt::format("{} is not compared", name));
    return *found;
}

std::span<const ComparedStructure> compared_structures() {
    static constexpr ComparedStructure all[] = {
        {"naive", any_size},
        {"bsp", 20'000},
        {"bsp-first", 5'000},
        {"kd-sah", 300'000},
        {"kd-middle", 150'000},
        {"kd-median", 150'000},
        {"kd-lazy", 900'000},
        {"octree", 300'000},
        {"octree-loose", 300'000},
        {"octree-linear", any_size},
        {"bvh-binned", any_size},
        {"bvh-sweep", 300'000},
        {"bvh-spatial", 300'000},
        {"bvh-optimised", 300'000},
        {"bvh-bottom-up", 300'000},
        {"bvh-morton", any_size},
        {"bvh-middle", 400'000},
        {"bvh-median", 400'000},
        {"bvh-parallel", any_size},
        {"bvh-parallel-morton", any_size},
        {"bvh-instanced", 400'000},
        {"fast", any_size},
        {"fast-scalar", 400'000},
        {"fast-4", 400'000},
        {"fast-compressed", 900'000},
        {"fast-hq", 400'000},
        {"embree", any_size},
        {"embree-high", 900'000},
        {"cgal", 300'000},
    };
    return all;
}

ComparedSubject make_subject(const std::string& scene, const std::string& spec,
                             std::uint64_t seed) {
    ComparedSubject subject{.scene = scene, .spec = spec};
    constexpr std::string_view graph = "graph/";
    Scene made;
    if (spec.starts_with(graph)) {
        subject.graph = make_nested_scene(std::string_view(spec).substr(graph.size()));
        subject.triangles = flatten(*subject.graph);
        const Aabb around = bounds(std::span<const Triangle>(subject.triangles));
        made.mesh = box(Double3(around.min), Double3(around.max));
        frame_mesh(made);
    } else {
        made = make_scene(spec, seed);
        subject.triangles = made.mesh.triangles();
    }
    subject.camera = made.camera;
    subject.coarser = compared_scene(scene).coarser;
    subject.lights = made.lights;
    return subject;
}

CompareEffort compare_effort(const Options& options) {
    CompareEffort effort;
    if (options.small || options.counts) effort.turns = effort.most_turns = 0;
    if (options.quick && !options.counts) effort.turns = effort.most_turns = 3;
    if (options.small) {
        effort.width = 8, effort.height = 6, effort.most_placed = 100'000;
        effort.blocks = {
            {"boxes", "boxes:12"}, {"stadium", "stadium:1"}, {"jacks", "graph/jacks:0"}};
        return effort;
    }
    if (options.quick && !options.counts) effort.width = 32, effort.height = 24;
    // All scenes in their smallest sizes, in their second ones ..., and those of files at last.
    for (std::size_t size = 0; size < 9; ++size)
        for (const ComparedScene& scene : compared_scenes())
            if (size < scene.specs.size() && !is_from_file(scene) && !(options.quick && size > 0))
                effort.blocks.emplace_back(scene.name, scene.specs[size]);
    for (const ComparedScene& scene : compared_scenes())
        if (is_from_file(scene) && !options.quick && is_there(scene.specs.front()))
            effort.blocks.emplace_back(scene.name, scene.specs.front());
    return effort;
}

}  // namespace space::ch12
