/// @file
/// Two searches in a tree of points, and the cells that each of them looks into.
#pragma once

#include "common/geometry.hpp"
#include "common/program/plane_view.hpp"
#include "common/program/svg.hpp"

#include <cstddef>
#include <string>

namespace space::ch04 {

/// What is asked: points lie between 0 and 10.
struct Searches {
    Point2 query{4.4f, 5.4f};
    std::size_t k = 6;  ///< the nearest so many, 1 to 12
    Aabb2 box{{3.4f, 4.0f}, {6.4f, 7.6f}};
};

/// The answers.
struct DrawnSearches {
    Svg drawing;
    std::string tells;  ///< in a sentence or two
};
DrawnSearches drawn_searches(const Searches& asked);

/// Where the two searches, 0 and 1, have their planes.
PlaneView search_view(std::size_t search);

}  // namespace space::ch04
