/// Heinonen16's Algorithm 2, RAKENNA_BSP_PUU, as it is printed (claim H17).
#include "chapters/ch03_bsp_trees/measured/measurements.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <memory>

namespace space::ch03 {
namespace {

/// The thesis' class BSP_Node.
struct PrintedNode {
    std::optional<std::uint32_t> splitter;
    std::unique_ptr<PrintedNode> right, left;
};

/// Line by line. Where the printed algorithm goes down to a child that nobody has made, this one
/// counts it and goes on without.
class AsPrinted {
  public:
    AsPrinted(std::span<const Triangle> polygons, PrintedTree& counts)
        : polygons_(polygons), counts_(counts) {}

    void build(PrintedNode* node, const std::vector<Fragment<3>>& set) {
        ++counts_.splitters;
        planes_.emplace_back(polygons_[set.front().polygon]);  // line 1, stored nowhere
        const auto plane = static_cast<std::uint32_t>(planes_.size() - 1);
        const Cutter<3> cutter(polygons_, planes_, Grade::exact, 0.0);
        std::vector<Fragment<3>> positive, negative;
        for (const Fragment<3>& fragment : set) {  // lines 4 to 15
            std::vector<int> sides;
            cutter.corner_sides(fragment, planes_.back(), sides);
            const PlaneSide side = Cutter<3>::classify(sides);
            if (side == PlaneSide::front)
                positive.push_back(fragment);
            else if (side == PlaneSide::back)
                negative.push_back(fragment);
            else if (side == PlaneSide::straddling) {
                auto [front, back] = cutter.split(fragment, sides, plane);
                positive.push_back(std::move(front));
                negative.push_back(std::move(back));
            } else if (fragment.polygon != set.front().polygon)
                ++counts_.coplanar;  // no line says where
        }
        if (!positive.empty()) build(child(node, &PrintedNode::right), positive);  // lines 16 to 21
        if (!negative.empty()) build(child(node, &PrintedNode::left), negative);
    }

  private:
    PrintedNode* child(PrintedNode* node, std::unique_ptr<PrintedNode> PrintedNode::*side) {
        PrintedNode* made = node ? (node->*side).get() : nullptr;
        counts_.missing_children += !made;
        return made;
    }

    std::span<const Triangle> polygons_;
    std::vector<SplitPlane<3>> planes_;
    PrintedTree& counts_;
};

std::uint64_t stored_splitters(const PrintedNode& node) {
    std::uint64_t stored = node.splitter.has_value();
    for (const auto* child : {node.right.get(), node.left.get()})
        if (child) stored += stored_splitters(*child);
    return stored;
}

}  // namespace

std::vector<PrintedTree> build_as_printed(const Options& options) {
    std::vector<PrintedTree> trees;
    for (const char* name : {"soup:300", "boxes:26", "lattice:1"}) {
        const std::vector<Triangle> triangles =
            make_scene(name, options.seed, options.small).mesh.triangles();
        PrintedTree tree{.scene = name, .polygons = triangles.size()};
        std::vector<Fragment<3>> all;
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            all.push_back(whole_polygon<3>(triangles[i], i));
        PrintedNode root;
        AsPrinted(triangles, tree).build(&root, all);
        tree.stored = stored_splitters(root);
        trees.push_back(tree);
    }
    return trees;
}

}  // namespace space::ch03
