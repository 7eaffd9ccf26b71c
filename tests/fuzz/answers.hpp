/// @file
/// Every structure's answers, bit for bit beside those of the naive loop.
#pragma once

#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/geometry.hpp"

#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace space::fuzz {

/// All structures of the lab over the same triangles, by the exact test. One that meets a limit is
/// left out.
class Answers {
  public:
    Answers(std::vector<Triangle> triangles, unsigned build_threads);
    /// Aborts where one answers otherwise than the naive loop.
    void compare(std::span<const Ray> rays) const;

  private:
    std::vector<Triangle> triangles_;
    std::vector<std::pair<std::string_view, BuiltStructure>> built_;  ///< the naive loop first
};

/// The same of structures that know instances, beside the flattened mesh's naive loop.
void compare_instances(const SceneGraph& graph);

}  // namespace space::fuzz
