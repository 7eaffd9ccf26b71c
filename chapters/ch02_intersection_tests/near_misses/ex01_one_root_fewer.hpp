/// @file
/// Exercise 2.1, a near miss: the square of the normal's length stays outside the root.
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
    const float square = glm::dot(n, n);
    return {root(glm::dot(of_b, of_b)) / square, root(glm::dot(of_c, of_c)) / square};
}

}  // namespace space
