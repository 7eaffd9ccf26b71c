#include "ex02_sah_cost.hpp"

#include "chapters/ch04_kd_trees/sah_sweep.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace {

/// A place on the axis: it can be compared, and counts how often it is.
class Place {
  public:
    Place() = default;
    explicit Place(float x) : x_(x) {}

    friend std::partial_ordering operator<=>(const Place& a, const Place& b) {
        ++comparisons;
        return a.x_ <=> b.x_;
    }
    friend bool operator==(const Place& a, const Place& b) {
        ++comparisons;
        return a.x_ == b.x_;
    }
    static inline std::size_t comparisons = 0;

    friend float seen_by_the_check(const Place& place) { return place.x_; }

  private:
    float x_ = 0.0f;
};

/// An extent whose ends can be seen.
struct Range {
    float low, high;

    friend std::ostream& operator<<(std::ostream& out, const Range& range) {
        return out << "from " << range.low << " to " << range.high;
    }
};

/// A plane with the numbers of boxes in its halves.
struct Candidate {
    float position;
    std::size_t below, above;

    auto operator<=>(const Candidate&) const = default;
    friend std::ostream& operator<<(std::ostream& out, const Candidate& plane) {
        return out << "at " << plane.position << ": " << plane.below << " below, " << plane.above
                   << " above";
    }
};

}  // namespace

using namespace space;

namespace {

using Boxes = std::vector<Extent<Place>>;

Boxes boxes_of(const std::vector<Range>& ranges) {
    Boxes boxes;
    for (const auto& [low, high] : ranges) boxes.push_back({Place(low), Place(high)});
    return boxes;
}

std::vector<Range> ranges_of(const Boxes& boxes) {
    std::vector<Range> ranges;
    for (const auto& [low, high] : boxes)
        ranges.push_back({seen_by_the_check(low), seen_by_the_check(high)});
    return ranges;
}

/// All planes, from low to high, with flat boxes below first.
std::vector<Candidate> candidates(const Boxes& boxes) {
    const std::vector<Range> ranges = ranges_of(boxes);
    std::set<float> places;
    for (const auto& [low, high] : ranges) places.insert({low, high});
    std::vector<Candidate> all;
    for (const float x : places) {
        std::size_t below = 0, above = 0, flat = 0;
        for (const auto& [low, high] : ranges) {
            below += low < x;
            above += high > x;
            flat += low == x && high == x;
        }
        all.push_back({x, below + flat, above});
        if (flat > 0) all.push_back({x, below, above + flat});
    }
    return all;
}

/// What the answer has asked for, and how often.
struct Sweep {
    std::optional<Tried<Place>> best;
    std::set<Candidate> tried;
    std::size_t calls = 0, comparisons = 0;
};

template <class Cost>
Sweep sweep(const Boxes& boxes, const Cost& cost) {
    Sweep result;
    Place::comparisons = 0;
    result.best = cheapest_plane(std::span<const Extent<Place>>(boxes),
                                 [&](Place place, std::size_t below, std::size_t above) -> double {
                                     ++result.calls;
                                     const float x = seen_by_the_check(place);
                                     result.tried.insert({x, below, above});
                                     return cost(x, below, above);
                                 });
    result.comparisons = Place::comparisons;
    return result;
}

/// Half the perimeters of a square with sides of 16, but for a factor: exact in whole coordinates.
double in_a_square(float x, std::size_t below, std::size_t above) {
    return (16.0 + double{x}) * double(below) + (32.0 - double{x}) * double(above);
}

std::set<Candidate> tried(const Boxes& boxes) {
    return sweep(boxes, in_a_square).tried;
}
std::set<Candidate> all(const Boxes& boxes) {
    const std::vector<Candidate> list = candidates(boxes);
    return {list.begin(), list.end()};
}

Boxes random_boxes(Pcg32& random, std::size_t count, std::uint32_t width) {
    Boxes boxes;
    while (boxes.size() < count) {
        const auto low = random.below(width + 1), length = random.below(width / 2 + 1);
        boxes.push_back({Place(float(low)), Place(float(std::min(low + length, width)))});
    }
    return boxes;
}

/// Within 1e-6 of each other, so that areas may be computed in float lengths.
Error apart(double is, double wanted) {
    return {is == wanted ? 0.0 : std::abs(is - wanted) / std::abs(wanted), 1e-6};
}

const Aabb cube{Point3(0), Point3(2)};

}  // namespace

TEST_CASE("cost: both halves of a cube are met by two of three rays") {
    CHECK(apart(sah_cost(cube, 0, 1, 3, 3), 1 + 2 * 4));
    CHECK(apart(sah_cost(cube, 1, 1, 6, 0), 1 + 2 * 4));
    CHECK(apart(sah_cost(cube, 2, 1, 0, 9), 1 + 2 * 6));
}

TEST_CASE("cost: areas count, not lengths or volumes, and each half has its own") {
    const Aabb cell{Point3(1, 1, 1), Point3(5, 2, 3)};  // half areas 14, and 5 and 11 across x = 2
    CHECK(apart(sah_cost(cell, 0, 2, 7, 14), 1 + 2 * (2.5 + 11)));
    CHECK(apart(sah_cost(cell, 0, 2, 14, 7), 1 + 2 * (5 + 5.5)));
    CHECK(apart(sah_cost(cell, 2, 1.5f, 14, 0), 1 + 2 * 6.5));
}

TEST_CASE("cost: a half without thickness still has two faces") {
    CHECK(apart(sah_cost(cube, 0, 0, 3, 0), 1 + 2 * 1));
    CHECK(apart(sah_cost(cube, 0, 2, 6, 3), 1 + 2 * (6 + 1)));
}

TEST_CASE("cost: of a flat cell the faces decide") {
    const Aabb flat{Point3(0, 0, 5), Point3(4, 8, 5)};
    CHECK(apart(sah_cost(flat, 0, 1, 4, 8), 1 + 2 * (1 + 6)));
    CHECK(apart(sah_cost(flat, 1, 2, 4, 8), 1 + 2 * (1 + 6)));
}

TEST_CASE("cost: of a cell that is a line lengths decide") {
    const Aabb line{Point3(3, 0, 5), Point3(3, 8, 5)};
    CHECK(apart(sah_cost(line, 1, 2, 4, 8), 1 + 2 * (1 + 6)));
    CHECK(apart(sah_cost(line, 1, 0, 4, 8), 1 + 2 * 8));
}

TEST_CASE("cost: no plane parts a cell across an axis on which it has no extent") {
    const Aabb flat{Point3(0, 0, 5), Point3(4, 8, 5)}, line{Point3(3, 0, 5), Point3(3, 8, 5)};
    const Aabb point{Point3(7), Point3(7)};
    CHECK(sah_cost(flat, 2, 5, 1, 0) == infinity);
    CHECK(sah_cost(line, 0, 3, 0, 1) == infinity);
    for (const int axis : {0, 1, 2}) CHECK(sah_cost(point, axis, 7, 0, 0) == infinity);
}

TEST_CASE("cost: cells of any size, as the book's") {
    Pcg32 random(42);
    for (int i = 0; i < 20'000; ++i) {
        // Products of such lengths are beyond floats; a third of all sides are flat.
        const double scale = std::exp2(random.uniform(-120.0f, 120.0f));
        const int axis = int(random.below(3));
        Aabb cell;
        for (int a = 0; a < 3; ++a) {
            const double low = scale * random.uniform(-1.0f, 0.0f);
            const double length = scale * random.uniform(0.01f, 1.0f);
            cell.min[a] = float(low);
            cell.max[a] = a != axis && random.below(3) == 0 ? cell.min[a] : float(low + length);
        }
        const float share = random.uniform();
        const float position = cell.min[axis] * (1.0f - share) + cell.max[axis] * share;
        const std::size_t below = random.below(1000), above = random.below(1000);
        const SahCost<3> book(cell, axis, {node_cost, test_cost, 0.0});
        CAPTURE(
            cell, "xyz" [axis], Number { position }, below, above);
        REQUIRE(apart(sah_cost(cell, axis, position, below, above),
                      book(position, below, above, below + above)));
    }
}

TEST_CASE("planes: what ends there is below alone, what begins there above, what crosses in both") {
    const Boxes boxes = boxes_of({{0, 4}, {2, 6}, {4, 8}});
    CHECK(tried(boxes) ==
          std::set<Candidate>{{0, 0, 3}, {2, 1, 3}, {4, 2, 2}, {6, 3, 1}, {8, 3, 0}});
    CHECK(tried(boxes_of({{1, 3}, {1, 3}, {3, 5}, {3, 5}})) ==
          std::set<Candidate>{{1, 0, 4}, {3, 2, 2}, {5, 4, 0}});
}

TEST_CASE("planes: flat boxes go below, and then above, all at once") {
    CHECK(tried(boxes_of({{3, 3}})) == std::set<Candidate>{{3, 1, 0}, {3, 0, 1}});
    CHECK(tried(boxes_of({{0, 3}, {3, 3}, {3, 3}, {3, 6}, {1, 5}})) ==
          std::set<Candidate>{{0, 0, 5}, {1, 1, 5}, {3, 4, 2}, {3, 2, 4}, {5, 5, 1}, {6, 5, 0}});
}

TEST_CASE("planes: without boxes there is none") {
    CHECK_FALSE(sweep({}, in_a_square).best.has_value());
}

TEST_CASE(
    "planes: of small random sets all are tried, and the cheapest wins, of equals the first") {
    Pcg32 random(43);
    int with_flat_above = 0, ties = 0;
    for (int i = 0; i < 5'000; ++i) {
        const Boxes boxes = random_boxes(random, 1 + random.below(12), 16);
        const std::vector<Candidate> planes = candidates(boxes);
        // Where the surface decides, and where other things do.
        const double rim = 16.0 * random.below(2), lean = double(random.below(9)) - 4.0;
        const auto cost = [&](float x, std::size_t below, std::size_t above) {
            return (rim + double{x}) * double(below) + (rim + 16.0 - double{x}) * double(above) +
                   lean * double{x};
        };
        const auto cost_of = [&](const Candidate& c) { return cost(c.position, c.below, c.above); };
        const auto wanted = std::ranges::min_element(planes, {}, cost_of);
        // Of two planes in one place the second has flat boxes above.
        const bool flat_below =
            wanted == planes.begin() || std::prev(wanted)->position != wanted->position;
        with_flat_above += !flat_below;
        ties += std::ranges::count(planes, cost_of(*wanted), cost_of) > 1;
        const Sweep swept = sweep(boxes, cost);
        CAPTURE(ranges_of(boxes), *wanted);
        REQUIRE(swept.tried == std::set<Candidate>(planes.begin(), planes.end()));
        REQUIRE(swept.best.has_value());
        REQUIRE(seen_by_the_check(swept.best->position) == wanted->position);
        REQUIRE(swept.best->flat_below == flat_below);
        REQUIRE(swept.best->cost == cost_of(*wanted));
    }
    CHECK(with_flat_above > 200);
    CHECK(ties > 200);
}

TEST_CASE(
    "planes: a sweep needs n log n comparisons, and asks for each plane's cost once or twice") {
    Pcg32 random(44);
    for (const std::uint32_t width : {1'000'000u, 100u, 0u})
        for (const std::size_t n : {500u, 1'000u, 2'000u}) {
            const Boxes boxes = random_boxes(random, n, width);
            const Sweep swept = sweep(boxes, in_a_square);
            CAPTURE(n, width);
            REQUIRE(swept.tried == all(boxes));
            REQUIRE(
                Error{double(swept.comparisons), 16.0 * double(n) * std::log2(2.0 * double(n))});
            REQUIRE(Error{double(swept.calls), 4.0 * double(n)});
        }
}

TEST_CASE("both: the best of three axes costs as much as the book's") {
    Pcg32 random(45);
    for (int i = 0; i < 300; ++i) {
        SplitEvents<3> events;
        std::vector<Aabb> boxes;
        Aabb cell;
        for (std::uint32_t box = 0, count = 2 + random.below(30); box < count; ++box) {
            const Point3 corner = random_point(random, 0.0f, 8.0f);
            Point3 size = random_point(random, 0.0f, 2.0f);
            if (random.below(3) == 0) size[int(random.below(3))] = 0.0f;
            boxes.push_back({corner, corner + size});
            cell.extend(boxes.back());
            add_events<3>(events, boxes.back(), box);
        }
        for (auto& list : events) std::sort(list.begin(), list.end());
        struct {
            double least;
            void observe(const SahCandidate& candidate) { least = std::min(least, candidate.cost); }
        } book{test_cost * double(boxes.size())};  // a leaf's
        best_split<3>(events, cell, boxes.size(), {node_cost, test_cost, 0.0}, book);

        double least = test_cost * double(boxes.size());
        for (const int axis : {0, 1, 2}) {
            Boxes extents;
            for (const Aabb& box : boxes)
                extents.push_back({Place(box.min[axis]), Place(box.max[axis])});
            const auto best = sweep(extents, [&](float x, std::size_t below, std::size_t above) {
                                  return sah_cost(cell, axis, x, below, above);
                              }).best;
            if (best) least = std::min(least, best->cost);
        }
        CAPTURE(boxes, least, book.least);
        REQUIRE(apart(least, book.least));
    }
}
