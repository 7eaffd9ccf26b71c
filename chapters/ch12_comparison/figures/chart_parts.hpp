/// @file
/// What the charts of the comparison share: which sizes they show, and how a structure looks.
#pragma once

#include "chapters/ch12_comparison/measured/comparison_views.hpp"
#include "common/program/chart.hpp"
#include "common/program/plot.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch12 {

/// The scenes that a chart of one size shows, each at the size of the comparison.
inline std::vector<Block> shown_blocks(const Comparison& comparison) {
    return blocks_near(comparison, compared_size(comparison));
}
/// The sizes of one scene, from small to large.
std::vector<Block> sizes_of(const Comparison& comparison, std::string_view scene);

/// "soup_uneven" as a text in a drawing, where an underscore would lower what follows.
std::string scene_text(std::string_view scene);

/// Structures of one kind look alike.
struct Family {
    std::string_view name;
    Symbol symbol;
};
std::span<const Family> families();
const Family& family_of(const ComparedRow& row);

/// The mean of the logarithms; unknown for no value.
double geometric_mean(const std::vector<double>& values);

/// Symbols with their names in rows from (left, top), as many as fit into the width. Returns how
/// high they are.
struct KeyEntry {
    std::string_view name;
    Symbol symbol;
};
double draw_key(Svg& svg, double left, double top, double width, std::span<const KeyEntry> entries);
/// That of these families.
double draw_families(Svg& svg, double left, double top, double width,
                     std::span<const std::string_view> names);

}  // namespace space::ch12
