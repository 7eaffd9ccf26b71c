/// @file
/// Exercise 2.1: One square root fewer
/// Difficulty 1 of 3, about 15 minutes.
///
/// Lichter23's first test computes *u* and *v* as lengths of two cross products over the length of
/// the normal, with three square roots: one in each `glm::length`. The vectors are parallel, and
/// *u* and *v* are ratios of parallel vectors. Compute the same weights with at most two roots;
/// fewer are welcome. `Real` is float, or a number of the check's that counts its square roots and
/// knows `+ - * /` and `sqrt(x)`, without `std::`.
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
    // TODO: two square roots are enough
    return {glm::length(of_b) / glm::length(n), glm::length(of_c) / glm::length(n)};
}

}  // namespace space
