/// @file
/// Chapter 1's structure: none.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

namespace space {

std::vector<Structure> ch01_structures() {
    return {offer<Naive>("naive",
                         "no structure: every ray is tested against every triangle (chapter 1)")};
}

}  // namespace space
