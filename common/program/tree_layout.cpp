#include "common/program/tree_layout.hpp"

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

}  // namespace space
