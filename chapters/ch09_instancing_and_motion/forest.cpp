#include "chapters/ch09_instancing_and_motion/forest.hpp"

#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/placement.hpp"
#include "common/pcg32.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace space {
namespace {

constexpr double spacing = 4.0;  // of the places

double between(Pcg32& random, double low, double high) {
    return low + (high - low) * random.uniform_double();
}

glm::dmat3 turned(const Double3& axis, double degrees) {
    return rotation(axis, degrees);
}
constexpr Double3 x_axis{1, 0, 0}, y_axis{0, 1, 0}, z_axis{0, 0, 1};

/// A leaf or a needle: a rhombus along the frame's z, folded along its middle.
void add_leaf(TriangleMesh& mesh, const Double3& at, const glm::dmat3& frame, double length,
              double width) {
    const auto point = [&](double x, double y, double z) {
        return Point3(at + frame * Double3(x, y, z));
    };
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(),
                         {point(0, 0, 0), point(0.2 * width, -0.5 * width, 0.45 * length),
                          point(0, 0, length), point(0.2 * width, 0.5 * width, 0.45 * length)});
    mesh.faces.push_back({first, first + 1, first + 2});
    mesh.faces.push_back({first, first + 2, first + 3});
}

/// A stem of length 1 along z with leaves around it.
TriangleMesh twig(std::uint32_t leaves) {
    TriangleMesh mesh = tube({{0, 0, 0}, 0.02}, {{0, 0, 1}, 0.008}, 3, false);
    for (std::uint32_t i = 0; i < leaves; ++i) {
        const double along = (i + 1.0) / leaves;
        add_leaf(mesh, {0, 0, along},
                 turned(z_axis, 137.5 * i) * turned(y_axis, i + 1 == leaves ? 5.0 : 60.0), 0.5,
                 0.3);
    }
    return mesh;
}

/// A bough of a conifer, of length 1 along z; x is up. Its needles are a spray to both sides.
TriangleMesh bough() {
    TriangleMesh mesh = tube({{0, 0, 0}, 0.018}, {{0, 0, 1}, 0.005}, 3, false);
    constexpr int rows = 17;
    for (int row = 0; row < rows; ++row) {
        const double along = 0.12 + 0.86 * row / (rows - 1), reach = 0.42 * (1.08 - along) + 0.05;
        for (const double side : {-1.0, 1.0})
            for (const double lift : {-8.0, 22.0})
                add_leaf(mesh, {0, 0, along},
                         turned(x_axis, side * (lift > 0 ? 48.0 : 60.0)) * turned(y_axis, lift),
                         reach, 0.16 * reach + 0.02);
    }
    return mesh;
}

/// A conifer of height 1: a trunk and whorls of boughs.
GraphObject conifer(const std::string& name, Pcg32& random, std::uint32_t trunk,
                    std::uint32_t bough, double slender) {
    GraphObject tree{name};
    tree.instances.push_back({Affine{}, trunk});
    constexpr int whorls = 20, boughs = 6;
    for (int whorl = 0; whorl < whorls; ++whorl) {
        const double height = 0.13 + 0.85 * whorl / (whorls - 1);
        for (int i = 0; i < boughs; ++i) {
            const double spin = 360.0 / boughs * i + 37.0 * whorl + between(random, -12, 12);
            const double length =
                slender * (0.03 + std::pow(1.0 - height, 0.85)) * between(random, 0.8, 1.15);
            const double droop = 108.0 - 55.0 * height * height + between(random, -6, 6);
            tree.instances.push_back(
                {affine({.translation = {0, 0, height},
                         .rotation =
                             turned(z_axis, spin) * turned(y_axis, droop) * turned(z_axis, 180.0),
                         .scale = Double3(length)}),
                 bough});
        }
    }
    return tree;
}

/// A broad-leaved tree of height about 1: what grows from branches in a mesh, and twigs.
class BroadTree {
  public:
    BroadTree(Pcg32& random, double spread) : random_(random), spread_(spread) {
        grow({0, 0, 0}, glm::dmat3(0.3), 0.022, 0);
    }
    TriangleMesh branches;
    std::vector<Affine> twigs;

  private:
    static constexpr int levels = 4;

    void grow(const Double3& base, const glm::dmat3& frame, double radius, int level) {
        const Double3 end = base + frame[2];
        branches.append(tube({base, radius}, {end, 0.72 * radius}, level < 2 ? 6 : 4, false));
        if (level >= levels - 1)
            for (int i = 0; i < (level == levels ? 4 : 2); ++i) {
                const double spin = between(random_, 0, 360), tilt = between(random_, 20, 75);
                const double along = between(random_, 0.35, 1.0), size = between(random_, 0.9, 1.3);
                twigs.push_back(affine({.translation = base + along * frame[2],
                                        .rotation = frame / glm::length(frame[2]) *
                                                    turned(z_axis, spin) * turned(y_axis, tilt),
                                        .scale = Double3(0.085 * size)}));
            }
        if (level == levels) return;
        const double start = between(random_, 0, 360);
        for (int i = 0; i < 3; ++i) {
            const double spin = start + 120.0 * i + between(random_, -25, 25);
            const double tilt = spread_ * between(random_, 0.6, 1.25);
            const double shorter = between(random_, 0.68, 0.85);
            grow(end, frame * turned(z_axis, spin) * turned(y_axis, tilt) * glm::dmat3(shorter),
                 0.66 * radius, level + 1);
        }
    }

    Pcg32& random_;
    double spread_;
};

TriangleMesh ground(double half_side) {
    TriangleMesh mesh;
    constexpr std::uint32_t cells = 160;
    for (std::uint32_t j = 0; j <= cells; ++j)
        for (std::uint32_t i = 0; i <= cells; ++i) {
            const double x = half_side * (2.0 * i / cells - 1.0),
                         y = half_side * (2.0 * j / cells - 1.0);
            mesh.vertices.emplace_back(x, y, forest_ground(x, y));
        }
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            const std::uint32_t a = j * (cells + 1) + i, b = a + 1, c = b + cells + 1, d = c - 1;
            mesh.faces.push_back({a, b, c});
            mesh.faces.push_back({a, c, d});
        }
    return mesh;
}

}  // namespace

double forest_ground(double x, double y) {
    return 16.0 * std::sin(x / 71.0 + 0.4) * std::cos(y / 83.0) +
           7.0 * std::sin(x / 37.0 - y / 29.0) + 30.0 * std::cos(y / 190.0 + x / 410.0);
}

SceneGraph make_forest_graph(std::uint32_t size, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<GraphObject> objects{
        {"ground", ground(0.5 * spacing * size).triangles()},
        {"trunk", tube({{0, 0, 0}, 0.014}, {{0, 0, 1}, 0.002}, 6, false).triangles()},
        {"bough", bough().triangles()},
        {"twig", twig(18).triangles()},
    };
    std::vector<std::uint32_t> trees;
    const auto add = [&](GraphObject object) {
        objects.push_back(std::move(object));
        return static_cast<std::uint32_t>(objects.size() - 1);
    };
    for (const double slender : {0.20, 0.26, 0.32})
        trees.push_back(
            add(conifer(fmt::format("conifer {}", trees.size() + 1), random, 1, 2, slender)));
    for (const double spread : {28.0, 36.0, 44.0}) {
        const BroadTree tree(random, spread);
        const std::string name = fmt::format("broad-leaved tree {}", trees.size() - 2);
        GraphObject group{name};
        group.instances.push_back(
            {Affine{}, add({name + ", branches", tree.branches.triangles()})});
        for (const Affine& place : tree.twigs) group.instances.push_back({place, 3});
        trees.push_back(add(std::move(group)));
    }

    GraphObject forest{"forest"};
    forest.instances.push_back({Affine{}, 0});
    for (std::uint32_t j = 0; j < size; ++j)
        for (std::uint32_t i = 0; i < size; ++i) {
            const double x = spacing * (i - 0.5 * size + between(random, 0.1, 0.9)),
                         y = spacing * (j - 0.5 * size + between(random, 0.1, 0.9));
            // Kinds keep together: conifers on one side of a wavy border.
            const double border = std::sin(x / 47.0) + std::sin(y / 39.0 + 1.0);
            const bool is_conifer = border + between(random, -0.8, 0.8) > 0.0;
            const std::uint32_t kind = random.below(3) + (is_conifer ? 0 : 3);
            const double height =
                is_conifer ? between(random, 8.0, 15.0) : between(random, 6.0, 10.0);
            const double spin = between(random, 0, 360);
            forest.instances.push_back({affine({.translation = {x, y, forest_ground(x, y) - 0.1},
                                                .rotation = turned(z_axis, spin),
                                                .scale = Double3(height)}),
                                        trees[kind]});
        }
    objects.push_back(std::move(forest));
    const auto root = static_cast<std::uint32_t>(objects.size() - 1);
    return {std::move(objects), root};
}

}  // namespace space
