#include "common/program/tree_layout.hpp"

#include <algorithm>

namespace space {
namespace {

/// How many leaves a layout has, and how many levels below the root.
Double2 reach_of(const std::vector<Double2>& layout) {
    Double2 reach(0.0);
    for (const Double2& place : layout) reach = glm::max(reach, place + Double2(0.5, 0.0));
    return reach;
}

}  // namespace

std::vector<Double2> tree_layout(const std::vector<std::vector<std::size_t>>& children) {
    std::vector<Double2> places(children.size());
    double leaves = 0.0;
    const auto place = [&](const auto& self, std::size_t node, double level) -> double {
        double x = children[node].empty() ? leaves++ + 0.5 : 0.0;
        for (const std::size_t child : children[node])
            x += self(self, child, level + 1.0) / static_cast<double>(children[node].size());
        places[node] = {x, level};
        return x;
    };
    if (!children.empty()) place(place, 0, 0.0);
    return places;
}

TreePaper::TreePaper(double leaves, double levels, const Double2& from, const Double2& size)
    : corner(from),
      slot(size.x / std::max(leaves, 1.0)),
      level(size.y / std::max(levels, 1.0)),
      shrink(std::min({1.0, slot / 34, level / 48})) {}

TreePaper::TreePaper(const std::vector<Double2>& layout, const Double2& from, const Double2& size)
    : TreePaper(reach_of(layout).x, reach_of(layout).y, from, size) {}

Point2 TreePaper::operator()(const Double2& place) const {
    return at(corner.x + slot * place.x, corner.y + level * place.y);
}

}  // namespace space
