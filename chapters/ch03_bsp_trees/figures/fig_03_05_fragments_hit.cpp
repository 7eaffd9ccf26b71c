// A closed mesh seen by rays that hit fragments in place of the triangles that those were cut from.

#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/painter.hpp"
#include "chapters/ch03_bsp_trees/tiling.hpp"
#include "common/camera.hpp"
#include "common/program/image.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

namespace space::ch03 {
namespace {

/// The palette's colours as a picture's pixels: linear.
constexpr Color sky{0.093f, 0.456f, 0.815f}, yellow{0.871f, 0.768f, 0.054f},
    vermillion{0.665f, 0.112f, 0.0f};

/// The mesh's tree in one grade, and its fragments.
struct Graded {
    Grade grade;
    const char* name;
    BspTree<3> tree;
    std::optional<FragmentRays> fragments = {};
};

/// A place on the common edge of two triangles where one of them, or both, have been cut.
struct Spot {
    std::array<std::uint32_t, 2> triangles;
    std::uint32_t cut;  ///< the one of them whose fragment has a corner here
    Double3 at;
};

/// What the rays of a small window about a spot see.
struct View {
    Image image{0, 0};
    std::uint64_t leaks = 0;
};

class Microscope {
  public:
    Microscope(const std::vector<Triangle>& triangles, const Spot& spot) : spot_(spot) {
        const auto normal = [&](std::uint32_t i) {
            return glm::normalize(SplitPlane<3>(triangles[i]).normal);
        };
        // From this near, directions in floats tell points apart that are closer than floats on the
        // surface.
        constexpr double distance = 0.002;
        camera_.eye = Point3(spot.at + distance * glm::normalize(normal(spot.triangles[0]) +
                                                                 normal(spot.triangles[1])));
        camera_.target = Point3(spot.at);
        camera_.field_of_view =
            static_cast<float>(2.0 * std::atan(0.5 * window / distance) * 180.0 / std::numbers::pi);
        // Upwards along the edge.
        for (int i = 0; i < 3; ++i) {
            const Triangle& first = triangles[spot.triangles[0]];
            const Triangle& second = triangles[spot.triangles[1]];
            if (edge_key(first, i) == edge_key(second, 0) ||
                edge_key(first, i) == edge_key(second, 1) ||
                edge_key(first, i) == edge_key(second, 2))
                camera_.up = glm::normalize(first[(i + 1) % 3] - first[i]);
        }
    }
    static constexpr double window = 0x1p-23;  // a float next to 0.25 is 2^-25 away

    View look(const FragmentRays& fragments, int side) const {
        View view{.image = Image(side, side)};
        const PixelGrid grid(camera_, side, side);
        grid.for_each([&](int x, int y) {
            const bool one = fragments.meets(grid.ray(x, y), spot_.triangles[0]),
                       other = fragments.meets(grid.ray(x, y), spot_.triangles[1]);
            view.leaks += !one && !other;
            view.image.at(x, y) = one ? sky : other ? yellow : vermillion;
        });
        return view;
    }

  private:
    Spot spot_;
    Camera camera_;
};

/// The corners of fragments that lie on the common edge of two triangles.
std::vector<Spot> spots(const BspTree<3>& tree) {
    std::map<EdgeKey, std::vector<std::uint32_t>> owners;
    for (std::uint32_t i = 0; i < tree.polygons.size(); ++i)
        for (int edge = 0; edge < 3; ++edge) owners[edge_key(tree.polygons[i], edge)].push_back(i);
    std::vector<Spot> found;
    for (const Fragment<3>& fragment : tree.fragments)
        for (const auto& corner : fragment.corners) {
            const auto [before, after] = corner.carriers;
            if (!before.is_original() || after.is_original()) continue;
            const auto& both = owners[edge_key(tree.polygons[fragment.polygon], before.edge())];
            if (both.size() == 2)
                found.push_back({{both[0], both[1]}, fragment.polygon, corner.at});
        }
    return found;
}

/// Where the leak is widest: one that canonical order closes, and one that it does not.
std::array<Spot, 2> widest_leaks(const std::vector<Triangle>& triangles,
                                 const std::array<Graded, 4>& graded) {
    std::array<Spot, 2> shown;
    std::array<std::uint64_t, 2> most{0, 0};
    const std::vector<Spot> in_order = spots(graded[1].tree);
    const auto both_cut = [&](const Spot& spot) {
        const auto here = [&](const Spot& other) {
            return other.triangles == spot.triangles && other.cut != spot.cut &&
                   glm::distance(other.at, spot.at) < Microscope::window;
        };
        return std::ranges::any_of(in_order, here);
    };
    for (const Spot& spot : spots(graded[0].tree)) {
        constexpr int coarse = 24;
        const Microscope microscope(triangles, spot);
        const auto leaks_in = [&](std::size_t grade) {
            return microscope.look(*graded[grade].fragments, coarse).leaks;
        };
        const std::uint64_t leaks = leaks_in(0);
        if (leaks <= std::min(most[0], most[1])) continue;
        const std::uint64_t ordered = leaks_in(1), still = std::min(leaks, ordered);
        const bool closed = ordered == 0 && leaks > most[0] && both_cut(spot),
                   open = still > most[1] && !both_cut(spot);
        if ((!closed && !open) || leaks_in(3) > 0)
            continue;  // at a vertex, where other triangles are about
        if (closed) most[0] = leaks, shown[0] = spot;
        if (open) most[1] = still, shown[1] = spot;
    }
    return shown;
}

}  // namespace

Svg fig_03_05(const Options&) {
    const std::vector<Triangle> triangles = teapot(5).triangles();
    std::array<Graded, 4> graded{{{Grade::thick_float, "own order", {}},
                                  {Grade::ordered_float, "canonical order", {}},
                                  {Grade::ordered_double, "in double", {}},
                                  {Grade::exact, "exact", {}}}};
    for (Graded& g : graded) {
        g.tree = BspBuilder<3>::build(triangles, {.grade = g.grade});
        g.fragments.emplace(g.tree, g.grade);
    }

    const std::array<Spot, 2> shown = widest_leaks(triangles, graded);
    constexpr int side = 150, gap = 8;
    Svg svg(
        "Two places on a teapot's edges, seen by rays that hit fragments in place of "
        "triangles, for four grades; leaks are marked",
        4 * side + 5 * gap, 524);
    constexpr std::array titles{"an edge at which both triangles are cut",
                                "an edge at which only one is cut: a T-junction"};
    for (std::size_t row = 0; row < shown.size(); ++row) {
        const Microscope microscope(triangles, shown[row]);
        svg.text({320, static_cast<float>(22 + 262 * row)}, titles[row], {.bold = true});
        for (std::size_t i = 0; i < graded.size(); ++i) {
            const View view = microscope.look(*graded[i].fragments, side);
            const auto left = static_cast<float>(gap + static_cast<int>(i) * (side + gap)),
                       top = static_cast<float>(38 + 262 * row);
            svg.picture({left, top}, {side, side}, view.image,
                        fmt::format("place-{}-{}", row + 1, i + 1));
            svg.rect({left, top}, {side, side}, {.stroke = Ink::quiet});
            svg.text({left + 0.5f * side, top + side + 20}, graded[i].name, {.size = 16});
            svg.text({left + 0.5f * side, top + side + 42},
                     view.leaks
                         ? fmt::format("{:.1f} % leak",
                                       100.0 * static_cast<double>(view.leaks) / (side * side))
                         : "no leak",
                     {.ink = view.leaks ? Ink::vermillion : Ink::quiet, .size = 16});
        }
    }
    return svg;
}

}  // namespace space::ch03
