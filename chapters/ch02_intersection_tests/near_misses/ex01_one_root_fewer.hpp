/// @file
/// Exercise 2.1, a near miss: the length of the normal is
/// saved in a variable, and one root with it; but glm::length takes a root as well, so that it is
/// three for four.
#pragma once

#include "common/geometry.hpp"

namespace space {

/// The weights of b and c: |of_b| / |n| and |of_c| / |n|, where n is the cross product of two of
/// the triangle's edges, and of_b and of_c are those of the parts of the triangle across from b and
/// c. All three are parallel.
template <class Real>
struct Weights {
    Real u, v;
};

template <class Real>
Weights<Real> weights(const glm::vec<3, Real>& of_b, const glm::vec<3, Real>& of_c,
                      const glm::vec<3, Real>& n) {
    const Real length = glm::length(n);
    return {glm::length(of_b) / length, glm::length(of_c) / length};
}

}  // namespace space
