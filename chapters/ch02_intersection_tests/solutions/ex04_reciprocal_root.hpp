/// @file
/// Exercise 2.4, solution.
#pragma once

namespace space {

/// y, a guess at 1 / sqrt(a), made better.
template <class Real>
Real refined(Real a, Real y) {
    for (int round = 0; round < 3; ++round) y *= 1.5f - 0.5f * a * y * y;  // y - f(y) / f'(y)
    return y;
}

}  // namespace space
