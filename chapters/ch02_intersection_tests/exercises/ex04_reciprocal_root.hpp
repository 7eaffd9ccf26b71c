/// @file
/// Exercise 2.4: Newton for the reciprocal root
/// Difficulty 2 of 3, about 20 minutes.
///
/// Newton's method for `y = 1 / sqrt(a)`, a zero of f(*y*) = 1 / *y*^2 - *a*, needs no division:
/// derive its step, and take as many rounds as the error allows. It begins with the chapter's
/// guess, which is made from the bits of *a* and up to 3.5 % off. Wanted is a relative error of at
/// most 2^-21 for every positive normal float; the exponent tells how many rounds that takes, and
/// more are wasted: at most 12 multiplications. `Real` is a float of the check's that counts them;
/// it can't be divided, and has no roots.
#pragma once

namespace space {

/// y, a guess at 1 / sqrt(a), made better.
template <class Real>
Real refined(Real a, Real y) {
    // TODO: Newton's step for 1 / y^2 - a, and enough rounds of it
    static_cast<void>(a);
    return y;
}

}  // namespace space
