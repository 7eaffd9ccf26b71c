/// @file
/// A ray's walk through a tree over segments of the plane, step by step. A chapter writes down what
/// its algorithm told an observer, a WalkStep for each event, with a sentence that says what it
/// means. This draws the plane and the tree side by side, and what waits below them.
#pragma once

#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <optional>
#include <string>
#include <vector>

namespace space {

/// A tree over segments in a square of the plane, as a drawing shows it.
struct DrawnTree {
    /// Without children a leaf, or an empty cell at the bottom.
    struct Node {
        std::string name;                        ///< as Svg::text takes it; an empty cell has none
        ConvexCell cell;                         ///< the part of the plane that it is about
        std::vector<Double2> lines = {};         ///< what divides it: two ends of each
        std::optional<Ink> ink = Ink::faint;     ///< of the lines while it is not in hand
        std::vector<std::size_t> children = {};  ///< from left to right on the paper
    };
    double size;  ///< of the square, from (0, 0) on
    std::vector<NamedSegment> segments;
    std::vector<Node> nodes;  ///< the root first
};

/// What a drawing shows in one step of a walk.
struct WalkStep {
    /// A node, and the part of the ray that it is about.
    struct Visit {
        std::size_t node;
        double enter, leave;
    };
    std::string tells = {};
    std::optional<Visit> in_hand = {};
    std::vector<Visit> waiting = {};       ///< a stack: what is taken next stands last
    std::optional<std::size_t> next = {};  ///< the node or the empty cell to which it goes
    std::vector<double> crossings = {};    ///< where the ray meets the lines of the node in hand
    std::vector<std::size_t> tested = {};  ///< segments that are asked in this step
    std::optional<double> hit = {};        ///< the nearest so far
};

/// "−2.5" and "[2.5, ∞)", for sentences.
std::string written_t(double t);
std::string interval(double enter, double leave);

/// The ray's t on a segment, in double; infinity where it misses.
double distance_along(const BasicRay<2>& ray, const Segment& segment);

/// Where such a drawing has its plane, a square from (0, 0) on.
PlaneView walk_view(double size);

/// The last step is what shows without scripts and on paper: let it sum up.
Svg walk_drawing(std::string title, const DrawnTree& tree, const BasicRay<2>& ray,
                 const std::vector<WalkStep>& steps);

}  // namespace space
