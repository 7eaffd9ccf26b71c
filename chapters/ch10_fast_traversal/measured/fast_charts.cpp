#include "chapters/ch10_fast_traversal/measured/fast_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace space::ch10 {
namespace {

/// Where a logarithmic axis shows that there is none.
constexpr double no_wrong_answer = 0.3;

/// The different values of a field, in the order in which they come.
template <class Point, class Field>
std::vector<std::string> different(const std::vector<Point>& points, Field Point::*field) {
    std::vector<std::string> names;
    for (const Point& p : points)
        if (std::ranges::find(names, std::string(p.*field)) == names.end())
            names.emplace_back(p.*field);
    return names;
}

/// "soup" for "soup:1000000": a name that stands below bars.
std::string brief(const std::string& scene) {
    return scene.substr(0, scene.find_first_of(":_"));
}
template <class Point>
std::vector<std::string> brief_scenes(const std::vector<Point>& points) {
    std::vector<std::string> names = different(points, &Point::scene);
    std::ranges::transform(names, names.begin(), brief);
    return names;
}

bool is_embree(std::string_view name) {
    return name.starts_with("Embree");
}

double mega_rays_per_second(double ns) {
    return 1e3 / ns;
}

/// A line for each scene over the rungs, which are numbered from 1 on; Embree's are the last ones.
template <class Value>
std::vector<Series> rungs_by_scene(const std::vector<RungPoint>& ladder, bool with_embree,
                                   const Value& value) {
    std::vector<Series> lines;
    const std::vector<std::string> rungs = different(ladder, &RungPoint::rung);
    for (const std::string& scene : different(ladder, &RungPoint::scene)) {
        Series line{.name = scene, .x = {}, .y = {}};
        for (const RungPoint& p : ladder) {
            if (p.scene != scene || p.kind != diffuse_kind) continue;
            if (is_embree(p.rung) && !with_embree) continue;
            line.x.push_back(1.0 + double(std::ranges::find(rungs, p.rung) - rungs.begin()));
            line.y.push_back(value(p));
        }
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace

Chart ladder_chart(const std::vector<RungPoint>& ladder) {
    Chart chart{.title = "Diffuse rays per second after each rung, and the machine's bound",
                .x_label = "rung",
                .y_label = "millions of diffuse rays per second",
                .log_y = true,
                .series = rungs_by_scene(
                    ladder, false, [](const RungPoint& p) { return mega_rays_per_second(p.ns); })};
    const std::size_t scenes = chart.series.size();
    for (std::size_t i = 0; i < scenes; ++i) {
        const std::string scene = chart.series[i].name;
        const std::vector<double> ends{chart.series[i].x.front(), chart.series[i].x.back()};
        for (const RungPoint& p : ladder) {
            if (p.scene != scene || p.kind != diffuse_kind) continue;
            if (p.rung == "Embree")
                chart.series[i].note = fmt::format("Embree: {:.2f}", mega_rays_per_second(p.ns));
            else if (p.bound_ns > 0.0 && chart.series.size() == scenes + i)
                chart.series.push_back(
                    {.name = "bound, " + scene,
                     .x = ends,
                     .y = std::vector<double>(2, mega_rays_per_second(p.bound_ns))});
        }
    }
    return chart;
}

Chart ladder_exactness_chart(const std::vector<RungPoint>& ladder) {
    return {.title = "Wrong answers per million aimed rays after each rung",
            .x_label = "rung",
            .y_label = "wrong answers per million aimed rays; below 1: none",
            .log_y = true,
            .series = rungs_by_scene(ladder, true, [](const RungPoint& p) {
                return std::max(p.wrong_per_million(), no_wrong_answer);
            })};
}

Chart latency_chart(const std::vector<MemoryPoint>& memory) {
    return {
        .title = "Time of a load against the size of what is read",
        .x_label = "bytes that are read in random order",
        .y_label = "ns for a load",
        .log_x = true,
        .log_y = true,
        .series = {series_along("one chain", memory, &MemoryPoint::bytes, &MemoryPoint::latency_ns),
                   series_along("eight at once", memory, &MemoryPoint::bytes,
                                &MemoryPoint::many_latency_ns)}};
}

Chart size_chart(const std::vector<SizePoint>& sizes) {
    Chart chart{.title = "Time of a diffuse ray against the number of triangles",
                .x_label = "triangles",
                .y_label = "ns for a diffuse ray",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string& structure : different(sizes, &SizePoint::structure)) {
        std::vector<SizePoint> points;
        for (const SizePoint& p : sizes)
            if (p.structure == structure && p.kind == diffuse_kind &&
                p.scene == sizes.front().scene)
                points.push_back(p);
        chart.series.push_back(
            series_along(structure, points, &SizePoint::triangles, &SizePoint::ns));
    }
    return chart;
}

Chart aimed_chart(const std::vector<AimedPoint>& aimed) {
    Chart chart{.title = "Speed against accuracy: rays at edges and vertices, by tracer",
                .x_label = "millions of aimed rays per second",
                .y_label = "wrong answers per million aimed rays; below 1: none",
                .log_x = true,
                .log_y = true,
                .kind = ChartKind::points,
                .series = {}};
    for (const std::string& tracer : different(aimed, &AimedPoint::tracer)) {
        Series dots{.name = tracer, .x = {}, .y = {}};
        for (const AimedPoint& p : aimed) {
            if (p.tracer != tracer) continue;
            dots.x.push_back(mega_rays_per_second(p.ns));
            dots.y.push_back(std::max(p.wrong_per_million(), no_wrong_answer));
        }
        chart.series.push_back(std::move(dots));
    }
    return chart;
}

Chart modes_chart(const std::vector<ModePoint>& modes, RayKind kind) {
    // Diffuse rays are in an order by chance, as they come after a few bounces.
    const std::string order = kind == diffuse_kind ? ", by chance" : "";
    Chart chart{.title = fmt::format("{} rays per second by mode, single rays = 1",
                                     kind == camera_kind ? "Camera" : "Diffuse"),
                .x_label = "scene",
                .y_label = fmt::format("{} rays per second, single = 1", ray_kinds[kind]),
                .kind = ChartKind::bars,
                .series = {},
                .categories = brief_scenes(modes)};
    const auto shown =
        kind == camera_kind
            ? std::vector<std::string>{"interleaved 8", "packets 16", "packets 64"}
            : std::vector<std::string>{"interleaved 8", "sorted, single", "sorted, interleaved 8",
                                       "sorted, packets 16"};
    for (const std::string& mode : shown)
        chart.add_bars(mode, [&](const std::string& scene) {
            for (const ModePoint& p : modes)
                if (brief(p.scene) == scene && p.mode == mode + order && p.kind == kind)
                    return p.gain();
            return 0.0;
        });
    return chart;
}

Chart fast_peers_chart(const std::vector<PeerPoint>& peers, RayKind kind) {
    Chart chart{.title = fmt::format("{} rays per second beside Embree, by scene",
                                     kind == camera_kind ? "Camera" : "Diffuse"),
                .x_label = "scene",
                .y_label = fmt::format("{} rays per second, Embree = 1", ray_kinds[kind]),
                .kind = ChartKind::bars,
                .series = {},
                .categories = brief_scenes(peers)};
    const auto add = [&](std::string_view name, double PeerPoint::*ns) {
        chart.add_bars(name, [&](const std::string& scene) {
            for (const PeerPoint& p : peers)
                if (brief(p.scene) == scene && p.kind == kind && p.*ns > 0.0)
                    return p.embree_ns / p.*ns;
            return 0.0;
        });
    };
    add("ours", &PeerPoint::ours_ns);
    add("ours, high", &PeerPoint::ours_high_ns);
    add("Embree robust", &PeerPoint::robust_ns);
    add("Embree high", &PeerPoint::embree_high_ns);
    return chart;
}

}  // namespace space::ch10
