#include "chapters/ch12_comparison/figures/chart_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace space::ch12 {

std::vector<Block> sizes_of(const Comparison& comparison, std::string_view scene) {
    std::vector<Block> sizes;
    for (const Block block : blocks(comparison))
        if (block.front().scene == scene) sizes.push_back(block);
    std::ranges::sort(sizes, {}, [](Block block) { return block.front().triangles; });
    return sizes;
}

std::string scene_text(std::string_view scene) {
    std::string text(scene);
    std::ranges::replace(text, '_', ' ');
    return text;
}

std::span<const Family> families() {
    static constexpr std::array<Family, 7> all{{
        {"naive", {Shape::star, Ink::ink, false, 7}},
        {"BSP", {Shape::upside_down, Ink::purple}},
        {"k-d", {Shape::square, Ink::green}},
        {"octrees", {Shape::diamond, Ink::orange, false, 6.5}},
        {"BVH", {Shape::circle, Ink::blue}},
        {"wide BVH", {Shape::triangle, Ink::vermillion, false, 6.5}},
        {"others' code", {Shape::circle, Ink::quiet, true}},
    }};
    return all;
}

const Family& family_of(const ComparedRow& row) {
    if (row.is_peer) return families().back();
    const std::string_view chapter = std::string_view(row.home).substr(row.home.find(' ') + 1);
    constexpr std::array<std::string_view, 6> firsts{"1", "3", "4", "6", "7", "10"};
    if (chapter == "5") return families()[2];
    if (chapter == "8" || chapter == "9") return families()[4];
    const auto found = std::ranges::find(firsts, chapter);
    return families()[static_cast<std::size_t>(found - firsts.begin()) % firsts.size()];
}

double geometric_mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += std::log(value);
    return values.empty() ? unknown : std::exp(sum / static_cast<double>(values.size()));
}

double draw_key(Svg& svg, double left, double top, double width,
                std::span<const KeyEntry> entries) {
    constexpr double size = 16, row = 24;
    double x = left, y = top + 18;
    for (const KeyEntry& entry : entries) {
        const double wide = 22 + text_width(entry.name, size) + 16;
        if (x > left && x + wide - 16 > left + width) x = left, y += row;
        draw_symbol(svg, at(x + 8, y - 5), entry.symbol);
        svg.text(at(x + 22, y), entry.name, {.anchor = Anchor::start, .size = size});
        x += wide;
    }
    return y + 8 - top;
}

double draw_families(Svg& svg, double left, double top, double width,
                     std::span<const std::string_view> names) {
    std::vector<KeyEntry> entries;
    for (const Family& family : families())
        if (std::ranges::find(names, family.name) != names.end())
            entries.push_back({family.name, family.symbol});
    return draw_key(svg, left, top, width, entries);
}

}  // namespace space::ch12
