/// @file
/// Chapter 5's structure: chapter 4's k-d tree, made where rays go.
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

namespace space {

std::vector<Structure> ch05_structures() {
    return {offer<LazyKdTree>("kd-lazy",
                              "as kd-sah; a node is made when a ray enters it (chapter 5)",
                              [](LazyKdTreeConfig& config, const Limits& limits) {
                                  config.max_references = limits.references;
                              })};
}

}  // namespace space
