/// @file
/// Exercise 5.1: First touch
/// Difficulty 2 of 3, about 30 minutes.
///
/// A lazy tree in one dimension. Its root's cell is all of the line; a plane cuts a cell in two
/// closed halves, and a point in the plane is named in one of them. `nearest(from, to)` walks from
/// `from` to `to`, either may be the larger, and returns the first point that it meets; both ends
/// belong to the way. Upwards the half below a plane comes first, downwards the half above it, also
/// for a way that begins in the plane. `make(node)` makes a node. Make those that the walk enters,
/// when it enters them, and no other: a node is entered if its cell holds a point of the way, and
/// if something nearer than what has been found could still lie in it. What one walk has made is
/// there for the next one; no node is made twice. The check sees what you make, and when.
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

    std::optional<double> nearest(double from, double to) {
        // TODO: this makes all nodes at the first walk, and asks every leaf
        if (points_.empty()) make_all(0);
        std::optional<double> first;
        for (const double point : points_) {
            const bool on_way =
                from <= to ? from <= point && point <= to : to <= point && point <= from;
            if (on_way && (!first || std::abs(point - from) < std::abs(*first - from)))
                first = point;
        }
        return first;
    }

  private:
    void make_all(std::size_t node) {
        const LineNode made = make_(node);
        points_.insert(points_.end(), made.points.begin(), made.points.end());
        if (made.is_leaf) return;
        make_all(2 * node + 1);
        make_all(2 * node + 2);
    }

    MakeNode make_;
    std::vector<double> points_;
};

}  // namespace space
