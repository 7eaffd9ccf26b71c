/// @file
/// Exercise 5.1, our answer.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace space {

/// A node of a tree over points of a line, once it is made. The children of node n are 2 n + 1,
/// below the plane, and 2 n + 2, above it.
struct LineNode {
    bool is_leaf;
    double plane;                ///< of an inner node
    std::vector<double> points;  ///< of a leaf, in any order
};

/// Makes a node; it takes long, and is to be done once.
using MakeNode = std::function<LineNode(std::size_t node)>;

class LazyLine {
  public:
    explicit LazyLine(MakeNode make) : make_(std::move(make)) {}

    std::optional<double> nearest(double from, double to) { return search(0, from, to); }

  private:
    /// The first point on the part of the way that lies in the node's cell.
    std::optional<double> search(std::size_t node, double from, double to) {
        const LineNode& made = node_at(node);
        if (made.is_leaf) return first_of(made.points, from, to);
        const std::size_t below = 2 * node + 1, above = 2 * node + 2;
        const double plane = made.plane;
        const bool upwards = from <= to;
        const bool begins_near = upwards ? from <= plane : from >= plane;
        const bool reaches_far = upwards ? to >= plane : to <= plane;
        if (begins_near) {
            const double end = reaches_far ? plane : to;
            if (const auto found = search(upwards ? below : above, from, end)) return found;
        }
        if (!reaches_far) return std::nullopt;
        return search(upwards ? above : below, begins_near ? plane : from, to);
    }
    const LineNode& node_at(std::size_t node) {
        const auto found = nodes_.find(node);
        return found != nodes_.end() ? found->second
                                     : nodes_.emplace(node, make_(node)).first->second;
    }
    static std::optional<double> first_of(const std::vector<double>& points, double from,
                                          double to) {
        std::optional<double> first;
        for (const double point : points) {
            const bool on_way =
                from <= to ? from <= point && point <= to : to <= point && point <= from;
            if (on_way && (!first || std::abs(point - from) < std::abs(*first - from)))
                first = point;
        }
        return first;
    }

    MakeNode make_;
    std::map<std::size_t, LineNode> nodes_;
};

}  // namespace space
