#include "common/program/tree_layout.hpp"

#include <algorithm>

namespace space {

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

TreePaper::TreePaper(double leaves, double levels)
    : slot(306 / std::max(leaves, 1.0)),
      level(296 / std::max(levels, 1.0)),
      shrink(std::min({1.0, slot / 34, level / 48})) {}

Point2 TreePaper::operator()(const Double2& place) const {
    return at(362 + slot * place.x, 32 + level * place.y);
}

}  // namespace space
