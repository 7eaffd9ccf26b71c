#include "chapters/ch10_fast_traversal/figures/walls.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "common/pcg32.hpp"

#include <array>
#include <utility>

namespace space::ch10 {

template <int D>
std::string Walls<D>::name(std::uint32_t node) const {
    std::string names;
    for (const std::uint32_t i : binary.own(node)) names += named[i].name;
    return names.empty() ? std::to_string(numbers[node]) : names;
}

template <int D>
Walls<D> walls_on(std::span<const Segment> segments) {
    constexpr float tall = 0x1p20f;
    Walls<D> walls{
        .segments = {segments.begin(), segments.end()}, .named = {}, .polygons = {}, .binary = {}};
    for (const Segment& segment : segments) {
        walls.named.push_back({std::string(1, static_cast<char>('A' + walls.named.size() % 26)),
                               Double2(segment.a), Double2(segment.b)});
        if constexpr (D == 2)
            walls.polygons.push_back(segment);
        else
            walls.polygons.push_back({{segment.a.x, segment.a.y, 0.0f},
                                      {segment.b.x, segment.b.y, 0.0f},
                                      {segment.a.x, segment.a.y, tall}});
    }
    walls.binary =
        BinnedBuilder::build<D>(walls.polygons, {.costs = {1.0, 1.0}, .max_leaf_size = 1});
    walls.numbers.resize(walls.binary.nodes.size());
    std::uint32_t next = 1;
    walls.binary.for_each_node([&](std::uint32_t index, unsigned) {
        if (!walls.binary.nodes[index].is_leaf()) walls.numbers[index] = next++;
    });
    return walls;
}
template struct Walls<2>;
template struct Walls<3>;
template Walls<2> walls_on<2>(std::span<const Segment>);
template Walls<3> walls_on<3>(std::span<const Segment>);

namespace {
/// Stretched, so that they fill the square up to a margin.
std::vector<Segment> spread_out(std::vector<Segment> segments) {
    constexpr float margin = 1.0f, size = static_cast<float>(heinonen_size) - 2.0f * margin;
    Aabb2 box;
    for (const Segment& segment : segments) {
        box.extend(segment.a);
        box.extend(segment.b);
    }
    for (Segment& segment : segments)
        for (Point2* const p : {&segment.a, &segment.b})
            *p = margin + size * (*p - box.min) / (box.max - box.min);
    return segments;
}
}  // namespace

std::vector<Segment> clustered_segments(std::uint64_t seed, int clusters, int in_each) {
    constexpr float cluster = 2.6f, length = 1.6f, size = static_cast<float>(heinonen_size);
    Pcg32 random(seed);
    std::vector<Segment> segments;
    for (int i = 0; i < clusters; ++i) {
        const float x = random.uniform(cluster, size - cluster);
        const float y = random.uniform(cluster, size - cluster);
        for (int j = 0; j < in_each; ++j) {
            std::array<float, 4> away;
            for (std::size_t k = 0; k < away.size(); ++k)
                away[k] = k < 2 ? random.uniform(0.4f - cluster, cluster - 0.4f)
                                : random.uniform(-length, length);
            const Point2 from(x + away[0], y + away[1]);
            segments.push_back({from, from + Vector2(away[2], away[3])});
        }
    }
    return spread_out(std::move(segments));
}

void draw_box_on(Svg& svg, const PlaneView& view, const Aabb2& box, double larger,
                 const Style& style) {
    const Double2 by(larger / view.scale);
    const Point2 corner = view(Double2(box.min.x, box.max.y) + Double2(-by.x, by.y)),
                 opposite = view(Double2(box.max.x, box.min.y) + Double2(by.x, -by.y));
    svg.rect(corner, opposite - corner, style);
}

ConvexCell box_corners(const Aabb2& box) {
    const Double2 low(box.min), high(box.max);
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}

std::vector<Double2> box_sides(const Aabb2& box) {
    const ConvexCell corners = box_corners(box);
    std::vector<Double2> ends;
    for (std::size_t i = 0; i < corners.size(); ++i)
        ends.insert(ends.end(), {corners[i], corners[(i + 1) % corners.size()]});
    return ends;
}

Ink wide_ink(std::size_t n) {
    constexpr std::array inks{Ink::blue,   Ink::vermillion, Ink::green,
                              Ink::purple, Ink::orange,     Ink::sky};
    return inks[n % inks.size()];
}

}  // namespace space::ch10
