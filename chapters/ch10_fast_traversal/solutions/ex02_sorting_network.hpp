/// @file
/// Exercise 10.2, our answer.
#pragma once

namespace space {

/// Calls exchange(i, j) for each pair of places, in order.
template <class Exchange>
void sort_four(const Exchange& exchange) {
    exchange(0, 1);
    exchange(2, 3);
    exchange(0, 2);
    exchange(1, 3);
    exchange(1, 2);
}

}  // namespace space
