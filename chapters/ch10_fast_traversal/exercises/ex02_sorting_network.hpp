/// @file
/// Exercise 10.2: A sorting network for four
/// Difficulty 1 of 3, about 20 minutes.
///
/// A ray comes to the four children of a node in the order in which it enters their boxes. To sort
/// four numbers by insertion is a row of branches that no processor can guess. A **sorting
/// network** has none: a fixed list of pairs of places, and whatever stands there, the smaller of
/// the two goes to the first place of the pair and the larger to the second. In SIMD that is a
/// minimum, a maximum and two permutations, for all pairs that share no place at once.
///
/// Give the pairs by calls: `exchange(i, j)` orders the places *i* and *j*, of 0 to 3. At the end
/// the smallest is to be at place 0 and the largest at place 3. Take no more than five exchanges.
/// (Those that share no place are done at once: any five that sort do it in three rounds.)
///
/// The check tries the 16 rows of zeros and ones: a network that sorts those sorts everything, the
/// 0-1 principle of Knuth (volume 3, section 5.3.4). Can you say why? And why four exchanges are
/// too few?
#pragma once

namespace space {

/// Calls exchange(i, j) for each pair of places, in order.
template <class Exchange>
void sort_four(const Exchange& exchange) {
    // TODO: after these two, each half is in order
    exchange(0, 1);
    exchange(2, 3);
}

}  // namespace space
