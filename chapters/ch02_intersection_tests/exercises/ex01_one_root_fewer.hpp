/// @file
/// Exercise 2.1: One square root fewer
/// Difficulty 1 of 3, about 15 minutes.
///
/// Lichter23's first test computes u and v as lengths of two cross products over the length of the
/// normal, with three square roots: the lengths of the three vectors. They are parallel, and u and
/// v are ratios of parallel vectors. Compute the same weights with at most two roots. `root` counts
/// how often it is called; fewer than two is welcome.
#pragma once

#include "common/geometry.hpp"

namespace space {

/// The weights of b and c: |of_b| / |n| and |of_c| / |n|, where n is the cross product of two of
/// the triangle's edges, and of_b and of_c are those of the parts of the triangle across from b and
/// c. All three are parallel.
struct Weights {
    float u, v;
};

template <class Root>
Weights weights(const Vector3& of_b, const Vector3& of_c, const Vector3& n, const Root& root) {
    // TODO: two square roots are enough
    const float length = root(glm::dot(n, n));
    return {root(glm::dot(of_b, of_b)) / length, root(glm::dot(of_c, of_c)) / length};
}

}  // namespace space
