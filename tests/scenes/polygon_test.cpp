// Faces that touch or cross themselves: what is inside by the even-odd rule, and nothing else, is
// covered once.
#include "common/mesh_reader/triangulate.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace space {
namespace {

using Corner = std::array<int, 2>;
using Ring = std::vector<Corner>;

/// Where a drawing on squared paper stands in space; each keeps x and y to look at it again.
using Place = Double3 (*)(double x, double y);
constexpr Place places[] = {[](double x, double y) {
                                return Double3{x, y, 0};
                            },
                            [](double x, double y) {
                                return Double3{x, y, 7 - x};
                            },
                            [](double x, double y) {
                                return Double3{x, y, x + 2 * y};
                            },
                            [](double x, double y) {
                                return Double3{x, y, 3 * x - 2 * y};
                            }};

/// The ring as one face; equal corners share a vertex or have one each.
TriangleMesh cut(const Ring& ring, bool shared, Place place = places[0]) {
    mesh_reader::Polygons polygons;
    std::map<Corner, std::uint32_t> indices;
    for (const Corner& corner : ring) {
        const auto next = static_cast<std::uint32_t>(polygons.points.size());
        const std::uint32_t index = shared ? indices.try_emplace(corner, next).first->second : next;
        if (index == next) polygons.points.push_back(place(corner[0], corner[1]));
        polygons.corners.push_back(index);
    }
    polygons.end_face();
    return mesh_reader::triangulate({"ring", {}}, std::move(polygons));
}

std::int64_t turn(const std::array<std::int64_t, 2>& a, const std::array<std::int64_t, 2>& b,
                  const std::array<std::int64_t, 2>& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Squared paper in so fine units that random points lie on no line between its corners, nearly.
constexpr std::int64_t unit = 1009;
std::array<std::int64_t, 2> on_paper(const Point3& p) {
    return {std::llround(p.x) * unit, std::llround(p.y) * unit};
}

/// In whole numbers, how many triangles hold a point; nothing if it is on one's edge.
std::optional<int> covers(const TriangleMesh& mesh, const std::array<std::int64_t, 2>& point) {
    int count = 0;
    for (const Triangle& t : mesh.triangles()) {
        const auto a = on_paper(t.a), b = on_paper(t.b), c = on_paper(t.c);
        const std::int64_t ab = turn(a, b, point), bc = turn(b, c, point), ca = turn(c, a, point);
        if ((ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0))
            ++count;
        else if ((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0))
            return std::nullopt;
    }
    return count;
}

/// Even-odd rule in whole numbers: a ray to the right crosses the ring an odd number of times.
bool is_inside(const Ring& ring, const std::array<std::int64_t, 2>& point) {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        std::array<std::int64_t, 2> a{ring[i][0] * unit, ring[i][1] * unit};
        const Corner& next = ring[(i + 1) % ring.size()];
        std::array<std::int64_t, 2> b{next[0] * unit, next[1] * unit};
        if ((a[1] > point[1]) == (b[1] > point[1])) continue;
        if (a[1] > b[1]) std::swap(a, b);
        inside ^= turn(a, b, point) > 0;
    }
    return inside;
}

/// Twice the area that the triangles show, which all face the same way.
std::int64_t twice_area(const TriangleMesh& mesh, bool& one_way) {
    std::int64_t sum = 0, size = 0;
    for (const Triangle& t : mesh.triangles()) {
        const std::int64_t area = turn({std::llround(t.a.x), std::llround(t.a.y)},
                                       {std::llround(t.b.x), std::llround(t.b.y)},
                                       {std::llround(t.c.x), std::llround(t.c.y)});
        sum += area;
        size += std::abs(area);
    }
    one_way = size == std::abs(sum);
    return sum;
}

std::int64_t twice_area(const Ring& ring) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Corner &a = ring[i], &b = ring[(i + 1) % ring.size()];
        sum += std::int64_t{a[0]} * b[1] - std::int64_t{b[0]} * a[1];
    }
    return sum;
}

/// What is wrong with the triangles of a ring that does not cross itself; empty if nothing is.
std::string fault(const Ring& ring, bool shared, Place place, Pcg32& random, int points) {
    const TriangleMesh mesh = cut(ring, shared, place);
    bool one_way = false;
    if (twice_area(mesh, one_way) != twice_area(ring)) return "another area";
    if (!one_way) return "triangles that face both ways";
    if (!mesh.remarks.empty()) return mesh.remarks.front();
    for (int i = 0; i < points; ++i) {
        const auto x = static_cast<std::int64_t>(random.below(14 * unit)) - unit;
        const auto y = static_cast<std::int64_t>(random.below(14 * unit)) - unit;
        const std::optional<int> count = covers(mesh, {x, y});
        if (count && *count != int(is_inside(ring, {x, y})))
            return fmt::format("{} triangles cover ({}, {}) / {}", *count, x, y, unit);
    }
    return {};
}

/// Every rotation of a ring and of its reverse, shared and separate corners, in space as it comes.
void check_all_ways(Ring ring, Pcg32& random, int points) {
    for (int way = 0; way < 2; ++way, std::reverse(ring.begin(), ring.end()))
        for (std::size_t first = 0; first < ring.size(); ++first) {
            std::rotate(ring.begin(), ring.begin() + 1, ring.end());
            for (const bool shared : {false, true}) {
                const std::string wrong =
                    fault(ring, shared, places[random.below(std::size(places))], random, points);
                INFO(fmt::format("way {}, first corner {}, shared {}", way, first, shared));
                REQUIRE(wrong == "");
            }
        }
}

TEST_CASE("rings that touch themselves are covered by the even-odd rule, whichever corner is first",
          "[mesh]") {
    const std::pair<const char*, Ring> rings[] = {
        {"keyhole",
         {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}}},
        {"touch", {{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}}},
        {"pinch", {{0, 0}, {4, 0}, {4, 4}, {2, 2}, {0, 4}, {0, 3}, {2, 2}, {0, 1}}},
        {"twice in a row",
         {{0, 0}, {6, 0}, {6, 0}, {6, 4}, {4, 4}, {4, 2}, {2, 2}, {2, 4}, {0, 4}, {0, 4}}},
        {"two holes that touch",
         {{0, 0},
          {8, 0},
          {8, 8},
          {0, 8},
          {0, 0},
          {2, 2},
          {2, 4},
          {4, 4},
          {4, 6},
          {6, 6},
          {6, 4},
          {4, 4},
          {4, 2},
          {2, 2}}},
        {"a hole that touches the outline",
         {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 3}, {2, 5}, {4, 3}, {2, 1}, {0, 3}}},
        {"a corner on an edge", {{0, 0}, {6, 0}, {6, 6}, {3, 0}, {0, 6}}},
        {"an edge on an edge", {{0, 0}, {6, 0}, {6, 6}, {4, 0}, {2, 0}, {0, 6}}},
        {"there and back", {{0, 0}, {6, 0}, {9, 3}, {6, 0}, {6, 6}, {0, 6}}},
        {"a spike along an edge", {{0, 0}, {6, 0}, {6, 9}, {6, 6}, {0, 6}}},
    };
    Pcg32 random(1);
    for (const auto& [name, ring] : rings) {
        INFO(name);
        check_all_ways(ring, random, 100);
    }
}

// ---- Polyominoes with holes, each joined to the outline by a bridge that is walked twice.

using Cells = std::set<Corner>;

Cells random_cells(Pcg32& random, int size) {
    Cells cells;
    for (int x = 0; x < size; ++x)
        for (int y = 0; y < size; ++y)
            if (random.below(100) < 68) cells.insert({x, y});
    Cells largest;
    while (!cells.empty()) {  // the largest part that hangs together
        Cells part;
        std::vector<Corner> open{*cells.begin()};
        while (!open.empty()) {
            const auto [x, y] = open.back();
            open.pop_back();
            if (cells.erase({x, y}) == 0) continue;
            part.insert({x, y});
            open.insert(open.end(), {{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}});
        }
        if (part.size() > largest.size()) largest = part;
    }
    return largest;
}

/// The loops of the boundary, cells on their left; where two meet in a corner either goes on.
std::vector<Ring> loops(const Cells& cells) {
    std::multimap<Corner, Corner> edges;
    for (const auto& [x, y] : cells) {
        if (!cells.contains({x, y - 1})) edges.insert({{x, y}, {x + 1, y}});
        if (!cells.contains({x + 1, y})) edges.insert({{x + 1, y}, {x + 1, y + 1}});
        if (!cells.contains({x, y + 1})) edges.insert({{x + 1, y + 1}, {x, y + 1}});
        if (!cells.contains({x - 1, y})) edges.insert({{x, y + 1}, {x, y}});
    }
    std::vector<Ring> result;
    while (!edges.empty()) {
        Ring loop;
        for (auto edge = edges.begin(); edge != edges.end(); edge = edges.find(loop.back())) {
            if (loop.empty()) loop.push_back(edge->first);
            loop.push_back(edge->second);
            edges.erase(edge);
        }
        loop.pop_back();
        result.push_back(loop);
    }
    return result;
}

/// Joins the holes to the outline, from the left: each by a level bridge to what is left of it.
Ring keyholed(std::vector<Ring> parts) {
    for (Ring& loop : parts)
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    std::sort(parts.begin(), parts.end(),
              [](const Ring& a, const Ring& b) { return a.front() < b.front(); });
    Ring ring = parts.front();
    for (std::size_t part = 1; part < parts.size(); ++part) {
        Ring& hole = parts[part];
        auto from = ring.end();
        for (Corner left = hole.front(); from == ring.end(); --left[0])
            from = std::find(ring.begin(), ring.end(), left);
        hole.push_back(hole.front());
        hole.push_back(*from);
        ring.insert(from + 1, hole.begin(), hole.end());
    }
    return ring;
}

TEST_CASE("polyominoes with bridged holes are covered where their cells are", "[mesh]") {
    Pcg32 random(2);
    int tried = 0;
    for (std::size_t holes[5] = {}; tried < 60;) {
        const Cells cells = random_cells(random, 5 + static_cast<int>(random.below(4)));
        const std::vector<Ring> parts = loops(cells);
        if (parts.size() < 2 || parts.size() > 5 || holes[parts.size() - 1]++ >= 15) continue;
        const Ring ring = keyholed(parts);
        INFO(fmt::format("polyomino {} with {} holes, {} corners", tried, parts.size() - 1,
                         ring.size()));
        REQUIRE(twice_area(ring) == 2 * std::int64_t(cells.size()));
        for (int x = 0; x < 8; ++x)
            for (int y = 0; y < 8; ++y)
                REQUIRE(is_inside(ring, {x * unit + 500, y * unit + 499}) ==
                        cells.contains({x, y}));
        check_all_ways(ring, random, 20);
        ++tried;
    }
}

// ---- The file's own precision.

TEST_CASE("a slit that no float can show keeps its ring open and crosses nothing", "[mesh]") {
    const test::Folder folder;
    Pcg32 random(5);
    for (const double slit : {1e-3, 1e-6, 1e-7, 1e-12})
        for (std::size_t round = 0; round < 84; ++round) {
            // Where the slit begins and ends: level, or so that each corner is rounded in its own
            // way and, as floats, one side crosses the other.
            const double at = round < 28 ? 3.0 : 2.5 + random.uniform_double();
            const double to = round < 28 ? 3.0 : 2.5 + random.uniform_double();
            std::vector<std::array<double, 2>> ring{{0, 0},
                                                    {6, 0},
                                                    {6, 6},
                                                    {0, 6},
                                                    {0, at + slit},
                                                    {0.5, 0.75 * at + 0.25 * to + slit},
                                                    {1.5, 0.25 * at + 0.75 * to + slit},
                                                    {2, to + slit},
                                                    {2, 4},
                                                    {4, 4},
                                                    {4, 2},
                                                    {2, 2},
                                                    {2, to},
                                                    {0, at}};
            std::rotate(ring.begin(), ring.begin() + std::ptrdiff_t(round % 14), ring.end());
            if (round % 28 >= 14) std::reverse(ring.begin(), ring.end());
            std::string obj;
            for (const auto& [x, y] : ring) obj += fmt::format("v {} {} 0\n", x, y);
            const TriangleMesh mesh =
                load_mesh(folder.write("ring.obj", obj + "f 1 2 3 4 5 6 7 8 9 10 11 12 13 14\n"));
            double area = 0.0;
            for (const Triangle& t : mesh.triangles()) {
                area += std::abs(double(normal(t).z)) / 2;
                const Point3 middle = (t.a + t.b + t.c) / 3.0f;
                CHECK_FALSE((middle.x > 2 && middle.x < 4 && middle.y > 2 && middle.y < 4));
            }
            CHECK(area == Approx(32.0).margin(2 * slit + 1e-6));  // corners are off by 2^-23
            CHECK(mesh.vertices.size() == 14);
            CHECK(mesh.remarks.empty());
        }
}

// ---- Outlines that cross themselves.

TEST_CASE("an outline that crosses itself is cut by the even-odd rule, and the mesh says so",
          "[mesh]") {
    const std::string cut_once = "1 face crosses itself: cut by the even-odd rule";
    const TriangleMesh bow = cut({{0, 0}, {2, 2}, {2, 0}, {0, 2}}, false);
    CHECK(bow.faces.size() == 2);
    CHECK(bow.vertices.back() == Point3{1, 1, 0});
    CHECK(bow.remarks == std::vector{cut_once});
    const TriangleMesh star = cut({{0, 10}, {6, -8}, {-10, 3}, {10, 3}, {-6, -8}}, false);
    CHECK(star.faces.size() == 5);  // its five points; the middle is wound about twice
    CHECK(star.remarks == std::vector{cut_once});
    CHECK(covers(star, {0, 0}) == 0);
    CHECK(covers(star, {0, 8 * unit}) == 1);
}

/// The least of the three products that are all positive where a point is in the triangle.
double depth(const Triangle& t, double x, double y) {
    const auto side = [&](const Point3& a, const Point3& b) {
        return (double(b.x) - a.x) * (y - a.y) - (double(b.y) - a.y) * (x - a.x);
    };
    const double sign = side(t.a, t.b) + side(t.b, t.c) + side(t.c, t.a) < 0 ? -1 : 1;
    return std::min({sign * side(t.a, t.b), sign * side(t.b, t.c), sign * side(t.c, t.a)});
}

TEST_CASE("any outline on squared paper is covered once where its windings are odd", "[mesh]") {
    Pcg32 random(6);
    constexpr double rounded = 1e-4;  // crossings are: points nearer to an edge decide nothing
    for (int round = 0; round < 400; ++round) {
        Ring ring;
        if (round % 4 == 0) {  // more than once about its first corner
            ring = {{6, 6}, {9, 6}, {7, 9}, {3, 8}, {4, 3}, {8, 2}, {12, 7}, {8, 12}, {1, 9}};
            ring.resize(6 + random.below(4));
        } else {
            for (std::uint32_t i = 0, corners = 4 + random.below(6); i < corners; ++i) {
                const int x = static_cast<int>(random.below(7));
                ring.push_back({x, static_cast<int>(random.below(7))});
            }
        }
        const TriangleMesh mesh = cut(ring, random.below(2) == 0);
        for (int i = 0; i < 50; ++i) {
            const auto x = static_cast<std::int64_t>(random.below(13 * unit));
            const auto y = static_cast<std::int64_t>(random.below(13 * unit));
            int count = 0;
            bool decided = true;
            for (const Triangle& t : mesh.triangles()) {
                const double d = depth(t, double(x) / unit, double(y) / unit);
                count += d > 0;
                decided = decided && std::abs(d) > rounded;
            }
            if (decided && count != int(is_inside(ring, {x, y})))
                FAIL_CHECK(fmt::format("round {}: {} triangles cover ({}, {}) / {}", round, count,
                                       x, y, unit));
        }
    }
}

TEST_CASE("faces that enclose nothing give no triangle", "[mesh]") {
    const test::Folder folder;
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::string twice = "f 1 2 3 1 2 3\n", there_and_back = "f 1 2 3 2\n";
    CHECK(test::complaint(folder.write("twice.obj", points + twice)) ==
          ": no face of the file encloses anything");
    const auto both = folder.write("both.obj", points + twice + there_and_back + "f 1 2 3\n");
    CHECK(load_mesh(both).faces.size() == 1);
    CHECK(test::remarks(both) == std::vector<std::string>{"2 faces enclose nothing: left out"});
}

TEST_CASE("large outlines are cut, and hopeless ones refused", "[mesh]") {
    Ring comb;
    for (int i = 0; i < 20000; ++i) comb.push_back({i, i % 2 * 100});
    comb.push_back({19999, -1});
    comb.push_back({0, -1});
    bool one_way = false;
    const TriangleMesh mesh = cut(comb, false);
    CHECK(mesh.faces.size() == comb.size() - 2);
    CHECK(twice_area(mesh, one_way) == twice_area(comb));
    CHECK(one_way);
#ifndef __SANITIZE_ADDRESS__  // the tessellator, stopped half-way, does not give all memory back
    Pcg32 random(3);
    Ring tangle;
    for (int i = 0; i < 2000; ++i) {
        const int x = static_cast<int>(random.below(1000000));
        tangle.push_back({x, static_cast<int>(random.below(1000000))});
    }
    CHECK_THROWS_WITH(cut(tangle, false), "ring: face 0 crosses itself more than 1000 times");
#endif
}

TEST_CASE("any outline gives finite vertices and indices in range", "[mesh]") {
    Pcg32 random(4);
    for (int round = 0; round < 5000; ++round) {
        mesh_reader::Polygons polygons;
        const double scales[] = {1.0, 1e-45, 1e-40, 1e30, 3e38, 1e-300};
        const double scale = scales[random.below(std::size(scales))];
        const std::uint32_t corners = 4 + random.below(9), kind = random.below(4);
        for (std::uint32_t i = 0; i < corners; ++i) {
            Double3 point;
            for (int axis = 0; axis < 3; ++axis) {
                const double step = static_cast<double>(random.below(4));
                point[axis] = scale * (kind == 0   ? step / 3
                                       : kind == 1 ? 0.5 + step * 0x1p-53
                                       : kind == 2 ? (axis == 2 ? 0.0 : step - 1.5) / 3
                                                   : random.next() * 0x1p-33);
            }
            polygons.points.push_back(point);
            polygons.corners.push_back(i);
        }
        polygons.end_face();
        const TriangleMesh mesh = mesh_reader::triangulate({"any", {}}, std::move(polygons));
        if (!mesh.faces.empty() && !test::is_sound(mesh)) FAIL_CHECK("round " << round);
    }
}

}  // namespace
}  // namespace space
