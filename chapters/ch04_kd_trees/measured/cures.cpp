#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/measured/measurements.hpp"
#include "chapters/ch04_kd_trees/published_kd_tree.hpp"
#include "common/program/progress.hpp"
#include "common/scenes/shapes.hpp"

#include <functional>

namespace space::ch04 {
namespace {

/// FilteredExact, and Lichter23's count: hits of one ray that are nearer than all before.
struct Finding {
    static inline float nearest = infinity;
    static inline std::uint64_t found = 0;

    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        const std::optional<Hit> hit = FilteredExact::intersect(ray, triangle);
        if (hit && hit->t < nearest) {
            nearest = hit->t;
            ++found;
        }
        return hit;
    }
};

struct CureScene {
    std::string name;
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
};

CureScene seen(std::string name, const TriangleMesh& mesh, const Limits& limit) {
    Scene scene;
    scene.mesh = mesh;
    frame_mesh(scene);
    return {std::move(name), mesh.triangles(),
            camera_rays(PixelGrid(scene.camera, limit.width, limit.height))};
}

/// Parallel to z, in planes that halve the scene's box again and again on x and on y.
std::vector<Ray> rays_along_z(const TriangleMesh& mesh, const Limits& limit) {
    const Aabb box = bounds(mesh);
    std::vector<Ray> rays;
    for (int y = 0; y <= limit.height; ++y)
        for (int x = 0; x <= limit.width; ++x) {
            const Vector3 share{float(x % 33) / 32.0f, float(y % 33) / 32.0f, 2.0f};
            rays.push_back({box.min + share * box.extent(), {0.0f, 0.0f, -1.0f}});
        }
    return rays;
}

/// A closed mesh of about as many triangles as Lichter23's; the same far from the origin, and on a
/// ground that is listed first; and rays that lie in the faces of the nodes' boxes.
std::vector<CureScene> cure_scenes(const Limits& limit) {
    const TriangleMesh pot = teapot(4);
    TriangleMesh ground;
    ground.vertices = {{0.0f, 0.0f, 3.0f}, {3.0f, 0.0f, -3.0f}, {-3.0f, 0.0f, -3.0f}};
    ground.faces = {{0, 1, 2}};
    ground.append(pot);
    const TriangleMesh ball = icosphere(9);
    CureScene on_ground = seen("teapot, its ground first", pot, limit);
    on_ground.triangles = ground.triangles();
    return {seen("teapot", pot, limit),
            seen("teapot at x = 10", moved(pot, {10.0, 0.0, 0.0}), limit),
            on_ground,
            {"ball, rays along z", ball.triangles(), rays_along_z(ball, limit)}};
}

/// As published, and each cure beside those before it.
struct Cure {
    std::string_view name;
    bool PublishedKdTreeConfig::*cure;
};
constexpr Cure cures[]{{"box of all corners", &PublishedKdTreeConfig::whole_scene_box},
                       {"overlap", &PublishedKdTreeConfig::sort_by_overlap},
                       {"safe box test", &PublishedKdTreeConfig::safe_box_test},
                       {"near child first", &PublishedKdTreeConfig::near_child_first},
                       {all_cures, &PublishedKdTreeConfig::early_end}};

using Answers = std::vector<std::optional<Hit>>;

template <Accelerator A>
Answers answers(const A& accelerator, const CureScene& scene, TraversalCounts& counts) {
    Answers all;
    for (const Ray& ray : scene.rays) {
        Finding::nearest = infinity;
        all.push_back(accelerator.closest_hit(ray, counts));
    }
    return all;
}

/// Timed are so many times fewer rays, evenly from all: without a tree they take long.
constexpr std::size_t timed_share = 4;

/// Counts one row, and says how its time can be taken.
template <Accelerator A>
CurePoint measure_row(const CureScene& scene, std::string_view cure, const A& accelerator,
                      Answers& truth, std::vector<std::function<void()>>& runs) {
    TraversalCounts counts;
    Finding::found = 0;
    const Answers own = answers(accelerator, scene, counts);
    if (truth.empty()) truth = own;
    CurePoint point{.scene = scene.name,
                    .cure = std::string(cure),
                    .triangles = scene.triangles.size(),
                    .rays = scene.rays.size(),
                    .tests = counts.triangles_tested,
                    .boxes = counts.nodes_visited,
                    .found = Finding::found};
    for (std::size_t i = 0; i < own.size(); ++i) point.lost += own[i] != truth[i];
    runs.push_back([&scene, accelerator] {
        for (std::size_t i = 0; i < scene.rays.size(); i += timed_share)
            do_not_optimize(closest_hit(accelerator, scene.rays[i]));
    });
    return point;
}

/// What the published tree does to the scene's box and to its triangles.
void look_at_root(CurePoint& point, const PublishedKdTree<Finding>& tree) {
    Aabb whole;
    for (const Triangle& triangle : tree.triangles()) whole.extend(bounds(triangle));
    point.box_area = tree.nodes()[0].box.half_area() / whole.half_area();
    std::vector<bool> named(tree.triangles().size());
    for (const std::uint32_t triangle : tree.references()) named[triangle] = true;
    point.dropped = static_cast<std::uint64_t>(std::ranges::count(named, false));
}

std::vector<CurePoint> measure_scene(const CureScene& scene, int rounds) {
    std::vector<CurePoint> points;
    std::vector<std::function<void()>> runs;
    Answers truth;
    const auto add = [&](std::string_view cure, const auto& accelerator) {
        points.push_back(measure_row(scene, cure, accelerator, truth, runs));
    };
    const auto add_published = [&](std::string_view cure, const PublishedKdTreeConfig& config) {
        const auto tree = PublishedKdTree<Finding>::build(scene.triangles, config);
        add(cure, tree);
        look_at_root(points.back(), tree);
    };
    add(no_tree, Naive<Finding>::build(scene.triangles));
    PublishedKdTreeConfig config;
    add_published(no_cure, config);
    for (const Cure& cure : cures) {
        config.*cure.cure = true;
        add_published(cure.name, config);
    }
    add(other_tree, KdTree<Finding>::build(scene.triangles));
    if (rounds == 0) return points;
    const std::vector<double> trace_ms = interleaved_medians(runs, rounds);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].trace_ms = timed_share * trace_ms[i];
    return points;
}

}  // namespace

std::vector<CurePoint> measure_cures(const Options& options) {
    const Limits limit = limits(options);
    const std::vector<CureScene> scenes = cure_scenes(limit);
    std::vector<CurePoint> points;
    Progress progress("cures", scenes.size());
    for (const CureScene& scene : scenes) {
        for (CurePoint& point : measure_scene(scene, limit.rounds)) points.push_back(point);
        progress.step();
    }
    return points;
}

}  // namespace space::ch04
