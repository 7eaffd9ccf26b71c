// The same segments in three quadtrees: named in all cells, kept where they fit, in loose cells.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/plane_cells.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_builder.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_walk.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace space::ch06 {
namespace {

constexpr double loose_size = 16.0, loose_side = 208;

/// Short ones, some of them across the middle of everything.
std::vector<Segment> short_segments() {
    Pcg32 random(6);
    std::vector<Segment> segments{{{0.0f, 0.0f}, {0.5f, 0.75f}}};  // where the root's corner is
    while (segments.size() < 64) {
        const Point2 middle = random_point<2>(random, {Point2(0.8f), Point2(15.2f)});
        const Vector2 half = random_point<2>(random, {Point2(-0.75f), Point2(0.75f)});
        if (glm::dot(half, half) > 0.16f) segments.push_back({middle - half, middle + half});
    }
    return segments;
}

/// What a random line does, on average.
struct Work {
    double visits = 0, tests = 0;
};
Work work_of_lines(const OrthtreeNodes<2>& tree) {
    constexpr int lines = 2000;
    struct Watcher {
        std::size_t visits = 0;
        void observe(const OrthtreeVisit<2>&) { ++visits; }
    } watcher;
    Pcg32 random(66);
    std::size_t tests = 0;
    for (int i = 0; i < lines; ++i) {
        const Point2 from = random_point<2>(random, {Point2(0.0f), Point2(16.0f)});
        const Point2 to = random_point<2>(random, {Point2(0.0f), Point2(16.0f)});
        NoCounts none;
        walk_orthtree(
            tree, OctreeConfig::Walk::parametric,
            Ray2{.origin = from, .direction = to - from, .tmin = -infinity}, none,
            [&](std::uint32_t node) {
                tests += tree.own(node).size();
                return double{infinity};
            },
            watcher);
    }
    return {double(watcher.visits) / lines, double(tests) / lines};
}

/// Where a segment is named: at the root every ray tests it.
Ink ink_at(std::uint32_t depth) {
    constexpr std::array inks{Ink::vermillion, Ink::orange, Ink::green, Ink::blue};
    return inks[std::min<std::size_t>(depth, inks.size() - 1)];
}

void draw_panel(Svg& svg, double left, const char* name, const std::vector<Segment>& segments,
                const OctreeConfig& config) {
    const PlaneView view{
        .corner = {left, 40}, .scale = loose_side / loose_size, .size = loose_size};
    const OrthtreeNodes<2> tree = OrthtreeBuilder<2>::build(segments, config);
    svg.text(at(left + 0.5 * loose_side, 22), name, {.size = 17, .bold = true});
    std::size_t at_root = 0;
    std::optional<OrthtreeBox<2>> shown;  // a loose cell, and how far it reaches
    std::vector<std::pair<std::uint32_t, Ink>> named;
    tree.for_each_cell([&](std::uint32_t index, const OrthtreeCell<2>& cell) {
        svg.polygon(view(corners_of(tree.frame.box(cell))), {.stroke = Ink::faint});
        if (cell.depth == 0) at_root = tree.own(index).size();
        if (cell == OrthtreeCell<2>{3, {4, 3}}) shown = tree.frame.box(cell);
        for (const std::uint32_t i : tree.own(index)) named.emplace_back(i, ink_at(cell.depth));
    });
    if (shown && tree.looseness > 1.0) {
        const Double2 more(0.5 * (tree.looseness - 1.0) * (shown->max - shown->min));
        svg.polygon(view(corners_of({shown->min - more, shown->max + more})),
                    {.stroke = Ink::quiet, .fill = Ink::sky, .opacity = 0.3, .dashed = true});
        svg.polygon(view(corners_of(*shown)), {.stroke = Ink::blue});
    }
    for (const auto& [i, ink] : named)
        svg.line(view(Double2(segments[i].a)), view(Double2(segments[i].b)), {.stroke = ink});
    const auto line = [&](double y, const std::string& text) {
        svg.text(at(left + 0.5 * loose_side, 40 + loose_side + y), text, {.size = 17});
    };
    line(26, fmt::format("{} names for {}", tree.references.size(), segments.size()));
    line(50, fmt::format("{} at the root", at_root));
    const Work work = work_of_lines(tree);
    line(74, fmt::format("a line: {:.0f} nodes,", work.visits));
    line(98, fmt::format("{:.0f} tests", work.tests));
}

}  // namespace

Svg fig_06_04(const Options&) {
    using Straddlers = OctreeConfig::Straddlers;
    const std::vector<Segment> segments = short_segments();
    OctreeConfig config{
        .costs = {.traversal = 0.0}, .max_leaf_size = 1, .max_depth = 4, .max_growth = 16};
    Svg svg(
        "Short segments in a quadtree that names them in all cells, in one that keeps them "
        "where they fit, and in a loose one",
        672, 40 + loose_side + 108);
    draw_panel(svg, 8, "in all cells", segments, config);
    config.straddlers = Straddlers::keep;
    draw_panel(svg, 232, "where they fit", segments, config);
    config.looseness = 2.0;
    draw_panel(svg, 456, "in loose cells", segments, config);
    return svg;
}

}  // namespace space::ch06
