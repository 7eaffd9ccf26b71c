#include "chapters/ch10_fast_traversal/measured/walk_counts.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

std::string per(std::uint64_t some, std::uint64_t all) {
    return fixed(double(some) / double(all), 1);
}

Table collapse_table(const WalkCounts& measured) {
    Table table({"scene", "children", "collapse", "expected cost", "wide nodes", "places used",
                 "bytes a triangle", "nodes a ray", "blocks a ray"});
    for (const CollapsePoint& p : measured.collapses)
        table.row({p.scene, std::to_string(p.width), std::string(p.way), fixed(p.cost, 1),
                   with_commas(p.nodes), percent(p.full()), fixed(p.bytes_per_triangle(), 1),
                   per(p.nodes_visited, p.rays), per(p.blocks_tested, p.rays)});
    return table;
}

Table met_table(const WalkCounts& measured) {
    std::vector<std::string> headings{"of all visits, in which"};
    for (std::size_t i = 0; i < 4; ++i) headings.push_back(fmt::format("{} met", i));
    headings.emplace_back("4 and more");
    Table table(std::move(headings));
    for (const MetPoint& p : measured.met) {
        std::vector<std::string> row{p.scene};
        double more = 1.0;
        for (std::size_t i = 0; i < 4; ++i) {
            row.push_back(percent(p.share(i)));
            more -= p.share(i);
        }
        row.push_back(percent(std::max(more, 0.0)));
        table.row(std::move(row));
    }
    return table;
}

Table order_table(const WalkCounts& measured) {
    Table table({"scene", "children are taken", "nodes a ray", "blocks a ray"});
    for (const OrderPoint& p : measured.orders)
        table.row({p.scene, std::string(p.order), per(p.nodes, p.rays), per(p.blocks, p.rays)});
    return table;
}

Table filter_table(const WalkCounts& measured) {
    Table table({"scene", "rays", "triangles tested", "left to the exact test", "of these hits",
                 "hits lost", "surely hit", "wrongly so", "largest error / bound"});
    for (const FilterPoint& p : measured.filter)
        table.row({p.scene, std::string(p.rays), with_commas(p.lanes), percent(p.left_share()),
                   with_commas(p.hits), with_commas(p.lost), with_commas(p.sure),
                   with_commas(p.invented), fixed(p.largest, 3)});
    return table;
}

Table plain_leaf_table(const WalkCounts& measured) {
    Table table({"scene", "rays at edges and vertices", "wrong in plain float", "wrong of ours"});
    for (const PlainLeafPoint& p : measured.plain_leaves)
        table.row({p.scene, with_commas(p.rays), with_commas(p.plain_wrong), with_commas(p.wrong)});
    return table;
}

Table slab_error_table(const WalkCounts& measured) {
    Table table({"from the origin", "planes", "on the wrong side", "fused", "fused, with margin",
                 "largest error / margin"});
    for (const SlabErrorPoint& p : measured.slabs)
        table.row({with_commas(static_cast<std::uint64_t>(p.away)), with_commas(p.planes),
                   with_commas(p.unsafe), with_commas(p.unsafe_fused),
                   with_commas(p.unsafe_fused_safely), fixed(p.largest, 3)});
    return table;
}

Table return_table(const WalkCounts& measured) {
    Table table({"scene", "rays that leave a wall", "back into its box", "fused, with margin"});
    for (const ReturnPoint& p : measured.returns)
        table.row({p.scene, with_commas(p.rays), percent(p.share_of_ours()),
                   percent(p.share_of_fused())});
    return table;
}

/// Sums over all points.
template <class Points, class Value>
std::uint64_t summed(const Points& points, const Value& value) {
    std::uint64_t sum = 0;
    for (const auto& point : points) sum += value(point);
    return sum;
}

}  // namespace

void print_walk_counts(const WalkCounts& measured) {
    print_heading("Collapses of one binary tree");
    collapse_table(measured).print();
    print_heading("Children that a visit to a node of eight meets");
    met_table(measured).print();
    print_heading("Orders of a node's children");
    order_table(measured).print();
    print_heading("What the filter of leaves decides");
    filter_table(measured).print();
    print_heading("Leaves in plain float, and ours");
    plain_leaf_table(measured).print();
    print_heading("Planes as kernels compute them");
    slab_error_table(measured).print();
    print_heading("Rays that leave a wall");
    return_table(measured).print();
}

void quote_walk_counts(const WalkCounts& measured, Numbers& numbers) {
    numbers.count_table("collapses", collapse_table(measured));
    numbers.count_table("met_children", met_table(measured));
    numbers.count_table("orders", order_table(measured));
    numbers.count_table("filter", filter_table(measured));
    numbers.count_table("plain_leaves", plain_leaf_table(measured));
    numbers.count_table("slab_errors", slab_error_table(measured));
    numbers.count_table("returns", return_table(measured));
    double largest = 0.0, few = 0.0;
    for (const SlabErrorPoint& p : measured.slabs) largest = std::max(largest, p.largest);
    numbers.count("slab_error_over_bound", largest, fixed(largest, 2));
    for (const MetPoint& p : measured.met)
        few += (p.share(0) + p.share(1) + p.share(2)) / double(measured.met.size());
    numbers.count("met_at_most_two", few, percent(few));
    double error = 0.0;
    for (const FilterPoint& p : measured.filter) error = std::max(error, p.largest);
    numbers.count("filter_error_over_bound", error, fixed(error, 2));
    std::uint64_t left = 0, lanes = 0;
    for (const FilterPoint& p : measured.filter)
        if (p.rays == "anywhere") left += p.left, lanes += p.lanes;
    const double left_share = double(left) / double(lanes);
    numbers.count("filter_undecided_share", left_share, percent(left_share));
    const auto rays = summed(measured.plain_leaves, [](const auto& p) { return p.rays; });
    const auto wrong = summed(measured.plain_leaves, [](const auto& p) { return p.plain_wrong; });
    const double per_million = 1e6 * double(wrong) / double(rays);
    numbers.count("plain_leaf_wrong", per_million,
                  with_commas(static_cast<std::uint64_t>(per_million + 0.5)));
}

std::uint64_t wrong_walk_counts(const WalkCounts& measured) {
    return summed(measured.filter, [](const auto& p) { return p.lost + p.invented; }) +
           summed(measured.plain_leaves, [](const auto& p) { return p.wrong; }) +
           summed(measured.slabs, [](const auto& p) { return p.unsafe + p.unsafe_fused_safely; });
}

}  // namespace space::ch10
