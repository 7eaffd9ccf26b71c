/// @file
/// A floating-point number of 113 bits: the difference of two floats is exact in it as long as one
/// is not 2^89 times the other, and so is the product of that with a float.
#pragma once

namespace space {

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quadruple;
#else
using Quadruple = long double;  // where processors have no __float128 it is as long
#endif

}  // namespace space
