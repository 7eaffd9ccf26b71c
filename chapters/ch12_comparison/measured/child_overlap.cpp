#include "chapters/ch12_comparison/measured/child_overlap.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"
#include "common/program/report.hpp"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <string>

namespace space::ch12 {

double child_overlap(const BvhNodes<3>& tree) {
    if (tree.empty()) return 0.0;
    const HitChance<3> chance(tree.nodes[0].box);
    double met = 0.0, met_by_both = 0.0;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        const BvhNode<3>& node = tree.nodes[index];
        if (node.is_leaf()) return;
        met += chance(node.box);
        const Aabb &a = tree.nodes[node.first].box, &b = tree.nodes[node.first + 1].box;
        const Aabb common{glm::max(a.min, b.min), glm::min(a.max, b.max)};
        if (glm::all(glm::lessThan(common.min, common.max))) met_by_both += chance(common);
    });
    return met > 0.0 ? met_by_both / met : 0.0;
}

void count_child_overlap(std::uint64_t seed, Numbers& numbers) {
    Table table({"scene", "triangles", "by bins", "by bins and spatial splits"});
    for (const ComparedScene& scene : compared_scenes()) {
        if (scene.specs.size() < 2) continue;  // of a file
        const ComparedSubject subject = make_subject(std::string(scene.name), scene.specs[1], seed);
        const auto overlap = [&]<class Builder>(Builder) {
            return percent(child_overlap(Builder::template build<3>(
                subject.triangles, typename Builder::Config{}, NoObserver{})));
        };
        table.row({std::string(scene.name), with_commas(subject.triangles.size()),
                   overlap(BinnedBuilder{}), overlap(SpatialSplitBuilder{})});
    }
    numbers.count_table("child_overlap", table);
}

}  // namespace space::ch12
