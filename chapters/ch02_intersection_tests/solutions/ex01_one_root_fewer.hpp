/// @file
/// Exercise 2.1, solution.
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
    const Real square = glm::dot(n, n);
    return {sqrt(glm::dot(of_b, of_b) / square), sqrt(glm::dot(of_c, of_c) / square)};
}

}  // namespace space
