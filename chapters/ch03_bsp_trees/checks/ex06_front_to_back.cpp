#include "ex06_front_to_back.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <vector>

using namespace space;

namespace {

using Cells = std::vector<int>;

/// Random lines with small whole coefficients, a few levels deep.
struct Plane {
    std::vector<CellNode> nodes;
    int cells = 0;

    int grow(Pcg32& random, int levels) {
        if (levels == 0 || (levels < 3 && random.below(3) == 0)) return ~cells++;
        const auto whole = [&] { return static_cast<double>(random.below(9)) - 4.0; };
        CellNode node{};
        while (node.normal == Double2(0)) {
            node.normal.x = whole();
            node.normal.y = whole();
        }
        node.offset = 2.0 * whole();
        const std::size_t index = nodes.size();
        nodes.push_back(node);
        const int front = grow(random, levels - 1), back = grow(random, levels - 1);
        nodes[index].front = front;
        nodes[index].back = back;
        return static_cast<int>(index);
    }
};

struct Passed {
    int cell;
    double enter, leave;
};

/// Each cell's part of the ray, from all lines above it: the other way round than a tree does it.
void passed(const std::vector<CellNode>& nodes, int child, Passed part, const Double2& origin,
            const Double2& direction, std::vector<Passed>& parts) {
    if (child < 0) {
        part.cell = ~child;
        parts.push_back(part);
        return;
    }
    const CellNode& node = nodes[static_cast<std::size_t>(child)];
    for (const double sign : {1.0, -1.0}) {
        const double height = sign * (glm::dot(node.normal, origin) - node.offset);
        const double slope = sign * glm::dot(node.normal, direction);
        Passed side = part;
        if (slope > 0.0) side.enter = std::max(side.enter, -height / slope);
        if (slope < 0.0) side.leave = std::min(side.leave, -height / slope);
        if (slope == 0.0 && height < 0.0) side.leave = -1.0;
        if (slope == 0.0 && height == 0.0) side.leave = side.enter;  // it runs along the border
        passed(nodes, sign > 0.0 ? node.front : node.back, side, origin, direction, parts);
    }
}

/// A tree of vertical lines at x = 1, 2, 3: cells 0 | 1 | 2 | 3 from left to right.
const std::vector<CellNode> stripes{{{1, 0}, 2, 1, 2}, {{1, 0}, 3, ~3, ~2}, {{1, 0}, 1, ~1, ~0}};

}  // namespace

TEST_CASE("a ray across stripes passes them in its order") {
    CHECK(cells_along(stripes, {0, 0}, {1, 0}) == Cells{0, 1, 2, 3});
    CHECK(cells_along(stripes, {4, 0}, {-1, 5}) == Cells{3, 2, 1, 0});
}

TEST_CASE("what is behind the origin is not passed") {
    CHECK(cells_along(stripes, {2.5, 0}, {1, 0}) == Cells{2, 3});
    CHECK(cells_along(stripes, {1.5, 0}, {-2, 1}) == Cells{1, 0});
    CHECK(cells_along(stripes, {9, 0}, {1, 0}) == Cells{3});
}

TEST_CASE("a ray along the stripes stays in its own") {
    CHECK(cells_along(stripes, {0.5, 0}, {0, 1}) == Cells{0});
    CHECK(cells_along(stripes, {2.5, 0}, {0, -3}) == Cells{2});
}

TEST_CASE("a ray in a node's line is not lost") {
    for (const double x : {1.0, 2.0, 3.0}) {
        const Cells cells = cells_along(stripes, {x, 0}, {0, 1});
        CAPTURE(x, cells);
        REQUIRE_FALSE(cells.empty());
        for (const int cell : cells) REQUIRE((cell == int(x) - 1 || cell == int(x)));
    }
}

TEST_CASE("random rays pass the cells of random trees in order, and no others") {
    Pcg32 random(36);
    int rays = 0;
    std::size_t longest = 0;
    for (int i = 0; i < 20'000; ++i) {
        Plane plane;
        plane.grow(random, 1 + i % 6);
        const auto whole = [&] { return static_cast<double>(random.below(17)) - 8.0; };
        const double x = whole(), y = whole(), dx = whole(), dy = whole();
        const Double2 origin(x + 0.25, y), direction(dx, dy);
        if (direction == Double2(0) || plane.nodes.empty()) continue;
        std::vector<Passed> parts;
        passed(plane.nodes, 0, {0, 0.0, infinity}, origin, direction, parts);
        // Rays that touch a cell are left out: either answer is right.
        if (std::ranges::any_of(parts,
                                [](const Passed& p) { return std::abs(p.leave - p.enter) < 1e-9; }))
            continue;
        std::erase_if(parts, [](const Passed& p) { return p.leave < p.enter; });
        std::ranges::sort(parts, {}, &Passed::enter);
        Cells wanted;
        for (const Passed& p : parts) wanted.push_back(p.cell);
        const Cells cells = cells_along(plane.nodes, origin, direction);
        ++rays;
        longest = std::max(longest, wanted.size());
        CAPTURE(plane.nodes.size(), origin, direction);
        REQUIRE(cells == wanted);
    }
    CHECK(rays > 10'000);
    CHECK(longest >= 6);
}
