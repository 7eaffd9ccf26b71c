// A path through the room with two blocks, step by step: the path that path_radiance takes with
// the same numbers.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace space::ch11 {
namespace {

constexpr Lighting drawn_lighting = Lighting::solid_angle;

/// What a path does at a surface.
struct PathVertex {
    Double3 position, light;
    bool is_lit;
    Double3 throughput;  ///< before the surface
    Double3 added;       ///< to the radiance at the eye
    double goes_on;      ///< the roulette's probability; 1 where there is none
    bool ends;
};

/// The path of path_radiance; empty if it meets a lamp or leaves.
std::vector<PathVertex> path_of(const LitPicture& box, Ray ray, Sampler sampler) {
    const Ray first = ray;
    Sampler again = sampler;
    const PathConfig config{.lighting = drawn_lighting};
    std::vector<PathVertex> path;
    Double3 throughput{1.0}, radiance{0.0};
    for (bool ends = false; !ends;) {
        const auto hit = closest_hit(box.tree, ray);
        if (!hit) return {};
        const SurfacePoint surface = surface_point(box.lit, ray, *hit);
        if (box.lit.emitted(surface.triangle, true) != Double3(0.0)) return {};
        Sampler ahead = sampler;
        const double choice = ahead.next();
        const LightSample light = sample_light(drawn_lighting, box.lights, Double3(surface.origin),
                                               choice, ahead.next_pair());
        const Double3 direct =
            irradiance_from_lights(box.tree, box.lights, surface, sampler, drawn_lighting);
        const Double3 added =
            throughput * box.lit.reflectance(surface.triangle) / std::numbers::pi * direct;
        PathVertex vertex{
            surface.position, light.point, direct != Double3(0.0), throughput, added, 1.0, false};
        radiance += added;
        const Reflection next = reflected(box.lit, surface, ray, sampler, drawn_lighting);
        ray = next.ray;
        throughput *= next.factor;
        if (static_cast<int>(path.size()) + 1 >= config.roulette_from) {
            vertex.goes_on = survival(throughput);
            ends = vertex.ends = sampler.next() >= vertex.goes_on;
            throughput /= vertex.goes_on;
        }
        path.push_back(vertex);
    }
    if (radiance != path_radiance(box.tree, box.lit, box.lights, first, again, config))
        throw std::logic_error("figure 11.18 draws another path than the path tracer's");
    return path;
}

/// The room on the paper: what comes nearer goes to the left and down.
Point2 oblique(const Double3& p) {
    return at(352 + 212 * (p.x - 0.38 * p.z), 520 - 212 * (p.y - 0.26 * p.z));
}

/// Whether no two points lie near each other on the paper.
bool is_readable(const std::vector<PathVertex>& path, const Double3& eye) {
    std::vector<Point2> points{oblique(eye)};
    for (const PathVertex& vertex : path) {
        const Point2 next = oblique(vertex.position);
        if (std::ranges::any_of(points, [&](Point2 p) { return glm::distance(p, next) < 80; }))
            return false;
        points.push_back(next);
    }
    return true;
}

/// The first path that ends after the fourth to sixth surface, with lamps seen and hidden.
std::vector<PathVertex> instructive_path(const LitPicture& box) {
    Sampler sampler(SamplePattern::independent, 1, 1);
    for (std::uint32_t i = 0; i < 100'000; ++i) {
        sampler.start(0, i);
        const Double2 in_picture = sampler.next_pair();
        const Ray ray =
            box.pixels().ray_through(box.width * in_picture.x, box.height * in_picture.y);
        const std::vector<PathVertex> path = path_of(box, ray, sampler);
        const auto lit = std::ranges::count_if(path, &PathVertex::is_lit);
        if (path.size() >= 4 && path.size() <= 6 && lit >= 2 &&
            lit < static_cast<std::ptrdiff_t>(path.size()) &&
            is_readable(path, Double3(ray.origin)))
            return path;
    }
    throw std::logic_error("figure 11.18 finds no path");
}

void draw_room(Svg& svg, const LitPicture& box) {
    for (std::size_t i = 12; i < box.lit.triangles.size(); ++i) {  // after the room's six sides
        const Triangle& t = box.lit.triangles[i];
        const bool is_lamp = box.lit.emitted(static_cast<std::uint32_t>(i), true) != Double3(0.0);
        svg.polygon({oblique(Double3(t.a)), oblique(Double3(t.b)), oblique(Double3(t.c))},
                    {.stroke = {}, .fill = is_lamp ? Ink::yellow : Ink::faint, .opacity = 0.7});
    }
    const Double3 low{-1, 0, -1}, high{1, 2, 1.5};
    for (int axis = 0; axis < 3; ++axis)
        for (int corner = 0; corner < 4; ++corner) {
            Double3 from = low;
            if (corner & 1) from[(axis + 1) % 3] = high[(axis + 1) % 3];
            if (corner & 2) from[(axis + 2) % 3] = high[(axis + 2) % 3];
            Double3 to = from;
            to[axis] = high[axis];
            svg.line(oblique(from), oblique(to), {.stroke = Ink::quiet});
        }
}

std::string written(const Double3& color) {
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", color.x, color.y, color.z);
}

std::string told(const PathVertex& vertex, std::size_t number) {
    std::string text =
        fmt::format("Surface {}, throughput {}. The lamp's point is {}: {} more light at the eye.",
                    number, written(vertex.throughput), vertex.is_lit ? "seen" : "hidden or behind",
                    vertex.is_lit ? written(vertex.added) : "no");
    if (vertex.goes_on < 1.0)
        text += fmt::format(" Roulette: the path goes on with the probability {:.2f}, and {}.",
                            vertex.goes_on, vertex.ends ? "ends" : "does");
    return text;
}

}  // namespace

Svg fig_11_18(const Options& options) {
    const LitPicture box("box", 320, 240, options.threads);
    const std::vector<PathVertex> path = instructive_path(box);
    Svg svg("A path from the eye through a room, and its rays to the lamp, step by step", 672, 624);
    draw_room(svg, box);
    Double3 from(box.lit.scene.camera.eye);
    svg.circle(oblique(from), 6, {.stroke = {}, .fill = Ink::ink});
    svg.text(moved(oblique(from), -12, -10), "eye",
             {.anchor = Anchor::end, .size = 18, .halo = true});
    for (std::size_t i = 0; i < path.size(); ++i) {
        const PathVertex& vertex = path[i];
        svg.begin_step(static_cast<int>(i), {}, told(vertex, i + 1));
        svg.line(oblique(from), oblique(vertex.position), {.stroke = Ink::blue, .arrow = true});
        svg.line(oblique(vertex.position), oblique(vertex.light),
                 {.stroke = vertex.is_lit ? Ink::orange : Ink::quiet, .dashed = true});
        svg.circle(oblique(vertex.position), 5, {.stroke = {}, .fill = Ink::blue});
        svg.text(moved(oblique(vertex.position), 12, -10), std::to_string(i + 1),
                 {.size = 18, .halo = true});
        svg.end_group();
        from = vertex.position;
    }
    return svg;
}

}  // namespace space::ch11
