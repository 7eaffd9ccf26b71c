#include "chapters/ch09_instancing_and_motion/measured/motion.hpp"
#include "chapters/ch09_instancing_and_motion/measured/moving_scenes.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"

#include <optional>
#include <utility>

namespace space::ch09 {
namespace {

struct FrameLimits {
    std::size_t frames, rays;
};
FrameLimits frame_limits(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {4, 300};
        case Amount::quick:
            return {20, 1'000};
        case Amount::full:
            break;
    }
    return {60, 4'000};
}

/// What rays cost in a tree, and whether it answers them as the one built anew.
FramePoint traced_point(const RefittedBvh<>& bvh, std::span<const Ray> rays,
                        const std::vector<std::optional<Hit>>& answers) {
    FramePoint point;
    TraversalCounts counts;
    for (std::size_t i = 0; i < rays.size(); ++i)
        point.wrong += bvh.closest_hit(rays[i], counts) != answers[i];
    point.rays = rays.size();
    point.nodes = counts.nodes_visited;
    point.tests = counts.triangles_tested;
    point.depth = bvh.nodes().depth;
    point.expected = bvh.nodes().sah_cost({});
    return point;
}

/// All frames of one scene, followed in each way.
void add_frames(const MovingScene& moving, const FrameLimits& limit, const Options& options,
                std::vector<FramePoint>& points) {
    auto follows = RefittedBvh<>::build(moving.at(0.0)), turns = follows;
    auto turns_singly =
        RefittedBvh<>::build(moving.at(0.0), {.costs = {0.0, 1.0}, .max_leaf_size = 1});
    for (std::size_t frame = 0; frame <= limit.frames; ++frame) {
        const auto moved = moving.at(double(frame) / double(limit.frames));
        follows.refit(moved);
        const std::size_t rotations = turns.refit_and_rotate(moved);
        const std::size_t rotations_singly = turns_singly.refit_and_rotate(moved);
        const auto anew = RefittedBvh<>::build(moved);
        const auto rays = rays_from_around(moved, limit.rays, options.seed + frame);
        std::vector<std::optional<Hit>> answers;
        for (const Ray& ray : rays) answers.push_back(closest_hit(anew, ray));
        const auto add = [&](std::string_view way, const RefittedBvh<>& bvh, std::size_t turned) {
            FramePoint point = traced_point(bvh, rays, answers);
            point.scene = moving.scene;
            point.motion = moving.motion;
            point.way = way;
            point.frame = frame;
            point.n = moved.size();
            point.rotations = turned;
            points.push_back(point);
        };
        add(built_anew, anew, 0);
        add(refitted, follows, 0);
        add(rotated, turns, rotations);
        add(rotated_singly, turns_singly, rotations_singly);
    }
}

std::vector<ScatterPoint> measure_scatters(const Options& options) {
    const auto rest =
        make_scene(options.small ? "soup:1000" : "soup:20000", options.seed).mesh.triangles();
    const auto built = RefittedBvh<>::build(rest);
    std::vector<ScatterPoint> points;
    for (const auto& [length, published] :
         {std::pair{0.01, 1.07}, {0.05, 2.03}, {0.1, 4.17}, {0.3, 19.0}, {1.0, 70.0}}) {
        std::vector<Triangle> moved(rest.size());
        move_to(length, Scatter{}, rest, moved);
        RefittedBvh<> follows = built;
        follows.refit(moved);
        const auto anew = RefittedBvh<>::build(moved);
        TraversalCounts before, after;
        ScatterPoint point{.length = length, .published = published};
        for (const Ray& ray : rays_from_around(moved, frame_limits(options).rays, options.seed)) {
            point.wrong += follows.closest_hit(ray, before) != anew.closest_hit(ray, after);
            ++point.rays;
        }
        point.nodes = double(before.nodes_visited) / double(after.nodes_visited);
        point.tests = double(before.triangles_tested) / double(after.triangles_tested);
        points.push_back(point);
    }
    return points;
}

}  // namespace

std::vector<FramePoint> measure_frames(const Options& options) {
    const std::vector<MovingScene> scenes = moving_scenes(options);
    std::vector<FramePoint> points;
    Progress progress("frames", scenes.size());
    for (const MovingScene& moving : scenes) {
        add_frames(moving, frame_limits(options), options, points);
        progress.step();
    }
    return points;
}

MotionMeasurements measure_motion(const Options& options) {
    MotionMeasurements measured;
    measured.refits = measured_once<measure_refits>(options);
    measured.scatters = measure_scatters(options);
    measured.frames = measured_once<measure_frames>(options);
    if (!options.counts || !options.quick)
        measured.policies = measured_once<measure_policies>(options);
    measured.crowd = measure_crowd(options);
    return measured;
}

std::uint64_t wrong_motion(const MotionMeasurements& measured) {
    std::uint64_t wrong = 0;
    for (const ScatterPoint& p : measured.scatters) wrong += p.wrong;
    for (const FramePoint& p : measured.frames) wrong += p.wrong;
    for (const CrowdPoint& p : measured.crowd)
        if (p.way != two_levels_local) wrong += p.wrong;
    return wrong;
}

}  // namespace space::ch09
