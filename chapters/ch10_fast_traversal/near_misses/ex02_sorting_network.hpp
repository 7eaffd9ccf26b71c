/// @file
/// Exercise 10.2, a near miss: bubbles that rise and fall, as bricks in a wall. Five exchanges in
/// three layers, and 20 of the 24 orders of four numbers come out sorted; but what stands at place
/// 0 cannot reach place 3.
#pragma once

namespace space {

/// Calls exchange(i, j) for each pair of places, in order.
template <class Exchange>
void sort_four(const Exchange& exchange) {
    exchange(0, 1);
    exchange(2, 3);
    exchange(1, 2);
    exchange(0, 1);
    exchange(2, 3);
}

}  // namespace space
