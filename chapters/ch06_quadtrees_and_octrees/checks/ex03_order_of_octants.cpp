#include "ex03_order_of_octants.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

using namespace space;

namespace {

using Children = std::vector<std::uint32_t>;

const OrthtreeBox<3> root{Double3(0.0), Double3(8.0)};

std::string words(const Children& children) {
    std::string text;
    for (const std::uint32_t child : children)
        text += (text.empty() ? "" : " ") + std::to_string(child);
    return text.empty() ? "none" : text;
}
std::string along(const Ray& ray) {
    return words(children_along(root, ray));
}

/// The ray and the numbers of the children, with the axes in `flip` the other way round.
Ray mirrored(Ray ray, std::uint32_t flip) {
    for (int axis = 0; axis < 3; ++axis)
        if ((flip >> axis & 1u) != 0) {
            ray.origin[axis] = 8.0f - ray.origin[axis];
            ray.direction[axis] = 0.0f - ray.direction[axis];  // 0 stays 0
        }
    return ray;
}
std::string mirrored(Children children, std::uint32_t flip) {
    for (std::uint32_t& child : children) child ^= flip;
    return words(children);
}
void require_mirrored(const Ray& ray, const Children& children) {
    for (std::uint32_t flip = 0; flip < 8; ++flip) {
        const Ray other = mirrored(ray, flip);
        CAPTURE(other);
        REQUIRE(along(other) == mirrored(children, flip));
    }
}

/// A quotient of whole numbers; 1 / 0 is infinity.
struct Fraction {
    long long above, below;

    bool operator<(const Fraction& other) const {
        return above * other.below < other.above * below;
    }
    static Fraction of(double distance, double direction) {
        const auto n = static_cast<long long>(distance), d = static_cast<long long>(direction);
        return d < 0 ? Fraction{-n, -d} : Fraction{n, d};
    }
    static Fraction of_quarters(float t) {
        return t == infinity ? Fraction{1, 0} : Fraction{static_cast<long long>(4.0f * t), 4};
    }
};

/// Child by child: from where to where the ray is in it, in exact numbers.
Children by_slabs(const OrthtreeBox<3>& box, const Ray& ray) {
    std::vector<std::pair<Fraction, std::uint32_t>> passed;
    for (std::uint32_t child = 0; child < 8; ++child) {
        Fraction begin = Fraction::of_quarters(ray.tmin), end = Fraction::of_quarters(ray.tmax);
        bool beside = false;
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = (child >> axis & 1u) != 0;
            const double middle = box.centre()[axis], low = upper ? middle : box.min[axis],
                         high = upper ? box.max[axis] : middle, o = ray.origin[axis],
                         d = ray.direction[axis];
            if (d == 0.0) {
                beside = beside || o < low || o > high || (o == high && !upper);
                continue;
            }
            begin = std::max(begin, Fraction::of((d > 0.0 ? low : high) - o, d));
            end = std::min(end, Fraction::of((d > 0.0 ? high : low) - o, d));
        }
        if (!beside && begin < end) passed.push_back({begin, child});
    }
    std::ranges::sort(passed, [](const auto& a, const auto& b) { return a.first < b.first; });
    Children children;
    for (const auto& [begin, child] : passed) children.push_back(child);
    return children;
}

int whole(Pcg32& random, int low, int high) {
    return low + int(random.below(std::uint32_t(high - low + 1)));
}

OrthtreeBox<3> random_root(Pcg32& random) {
    const double edge = 2.0 * whole(random, 1, 6);
    OrthtreeBox<3> box;
    for (int axis = 0; axis < 3; ++axis) box.min[axis] = whole(random, -20, 20);
    box.max = box.min + edge;
    return box;
}

/// Near the box or in it, often in its planes and along axes, half of them to a point of the box;
/// it may end anywhere.
Ray random_ray(Pcg32& random, const OrthtreeBox<3>& box) {
    Ray ray;
    const bool is_aimed = random.below(2) == 0;
    while (!is_valid(ray))
        for (int axis = 0; axis < 3; ++axis) {
            const int low = int(box.min[axis]), high = int(box.max[axis]);
            const bool is_in_plane = random.below(6) == 0;
            const int origin = is_in_plane ? (low + high) / 2 : whole(random, low - 3, high + 3);
            int direction = whole(random, -4, 4);
            if (is_aimed) direction = whole(random, low, high) - origin;
            ray.origin[axis] = float(origin);
            ray.direction[axis] = random.below(5) != 0 ? float(direction) : -0.0f;
        }
    if (random.below(3) == 0) ray.tmin = 0.25f * float(whole(random, -20, 20));
    if (random.below(3) == 0) ray.tmax = ray.tmin + 0.25f * float(whole(random, 0, 40));
    return ray;
}

}  // namespace

TEST_CASE("a ray along an axis passes two children, the nearer one first") {
    CHECK(along({{-1, 2, 2}, {1, 0, 0}}) == "0 1");
    CHECK(along({{9, 2, 2}, {-1, 0, 0}}) == "1 0");
    CHECK(along({{6, -1, 2}, {0, 2, 0}}) == "1 3");
    CHECK(along({{6, 6, 9}, {0, 0, -3}}) == "7 3");
}

TEST_CASE(
    "a ray that crosses the three planes one by one passes four children, whatever its signs") {
    require_mirrored({{0, 1, 3}, {2, 2, 1}}, {0, 4, 6, 7});
    require_mirrored({{3, 1, 0}, {1, 2, 2}}, {0, 1, 3, 7});
    require_mirrored({{0, 7, 0}, {3, -2, 2}}, {2, 3, 1, 5});
}

TEST_CASE("a ray that leaves the root before a plane, or enters it beyond one, does not cross it") {
    require_mirrored({{-1, 3, 5}, {3, 1, 1}}, {4, 6, 7});
    require_mirrored({{-1, 1, 1}, {1, 2, 0}}, {0, 2});
    require_mirrored({{3, -3, 1}, {1, 2, 0}}, {1, 3});
}

TEST_CASE("planes that are crossed at once are crossed together") {
    require_mirrored({{0, 0, 0}, {1, 1, 1}}, {0, 7});
    require_mirrored({{0, 0, 2}, {2, 2, 0}}, {0, 3});
    require_mirrored({{0, 0, 3}, {2, 2, 1}}, {0, 4, 7});
    require_mirrored({{2, 2, 1}, {1, 1, 1}}, {0, 3, 7});
}

TEST_CASE("planes that are crossed soon after each other are crossed one by one") {
    require_mirrored({{2, 2, 1}, {63, 64, 0}}, {0, 2, 3});
    require_mirrored({{2, 2, 1}, {99'999, 100'000, 0}}, {0, 2, 3});
    require_mirrored({{2, 2, 2}, {99'999, 99'998, 100'000}}, {0, 4, 5, 7});
}

TEST_CASE("a ray beside the root, behind it, or one that only touches it, passes no child") {
    CHECK(along({{-1, 2, 2}, {0, 1, 0}}) == "none");
    CHECK(along({{9, 2, 2}, {0, 1, 0}}) == "none");
    CHECK(along({{10, 2, 2}, {1, 0, 0}}) == "none");
    CHECK(along({{-2, 3, 4}, {1, -2, 0}}) == "none");
    require_mirrored({{-2, 2, 2}, {1, -1, 0}}, {});
    require_mirrored({{-1, 1, -2}, {1, -1, 2}}, {});
}

TEST_CASE("an axis on which the ray does not move keeps its half; a middle plane is the upper's") {
    for (const float zero : {0.0f, -0.0f}) {
        CAPTURE(zero);
        REQUIRE(along({{1, -1, 5}, {zero, 1, zero}}) == "4 6");
        REQUIRE(along({{7, 9, 1}, {zero, -1, zero}}) == "3 1");
        REQUIRE(along({{4, -1, 2}, {zero, 1, zero}}) == "1 3");
        REQUIRE(along({{4, 9, 4}, {zero, -1, zero}}) == "7 5");
        REQUIRE(along({{4, 0, 0}, {zero, 1, 1}}) == "1 7");
        REQUIRE(along({{8, 8, 4}, {-1, -1, zero}}) == "7 4");
        REQUIRE(along({{0, 8, 4}, {1, -1, zero}}) == "6 5");
    }
}

TEST_CASE("a ray in a face or an edge of the root passes the children there") {
    for (const float zero : {0.0f, -0.0f}) {
        CAPTURE(zero);
        REQUIRE(along({{0, -1, 2}, {zero, 1, zero}}) == "0 2");
        REQUIRE(along({{8, -1, 2}, {zero, 1, zero}}) == "1 3");
        REQUIRE(along({{8, 9, 8}, {zero, -1, zero}}) == "7 5");
        REQUIRE(along({{0, 9, 8}, {zero, -1, zero}}) == "6 4");
        REQUIRE(along({{0, 0, 8}, {1, 2, zero}}) == "4 6");
    }
}

TEST_CASE("a ray that begins in the root passes what lies before it") {
    require_mirrored({{1, 2, 3}, {0, 0, 2}}, {0, 4});
    require_mirrored({{5, 2, 3}, {1, 1, 0}}, {1, 3});
    require_mirrored({{5, 6, 7}, {1, 1, 1}}, {7});
    require_mirrored({{8, 6, 7}, {1, 1, 1}}, {});
}

TEST_CASE("a ray that begins in a middle plane begins on the side to which it goes") {
    require_mirrored({{4, 2, 2}, {1, 0, 0}}, {1});
    require_mirrored({{4, 4, 4}, {1, 2, 3}}, {7});
    require_mirrored({{4, 4, 1}, {2, 1, 3}}, {3, 7});
    CHECK(along({{4, 4, 4}, {-1, 0, 0}}) == "6");
    CHECK(along({{4, 4, 4}, {0, -1, 1}}) == "5");
}

TEST_CASE("what lies before tmin or beyond tmax is not passed, nor is a single point") {
    const Ray ray{{-2, 1, 1}, {1, 0, 0}};
    const auto between = [&](float tmin, float tmax) {
        return along({ray.origin, ray.direction, tmin, tmax});
    };
    CHECK(between(0, 7) == "0 1");
    CHECK(between(0, 6) == "0");
    CHECK(between(0, 2) == "none");
    CHECK(between(6, infinity) == "1");
    CHECK(between(7, 8) == "1");
    CHECK(between(5, 5) == "none");
    CHECK(between(10, infinity) == "none");
    CHECK(along({{10, 1, 1}, {1, 0, 0}, -20, infinity}) == "0 1");
    CHECK(along({{10, 1, 1}, {1, 0, 0}, -8, -5}) == "0 1");
}

TEST_CASE("random rays in random roots pass what exact fractions say, child by child") {
    Pcg32 random(1);
    std::size_t passes[5]{}, in_planes = 0;
    for (int i = 0; i < sized(100'000, 10'000); ++i) {
        const OrthtreeBox<3> box = random_root(random);
        const Ray ray = random_ray(random, box);
        const Children wanted = by_slabs(box, ray);
        ++passes[wanted.size()];
        for (int axis = 0; axis < 3; ++axis)
            in_planes += !wanted.empty() && ray.direction[axis] == 0.0f &&
                         double{ray.origin[axis]} == box.centre()[axis];
        const Children is = children_along(box, ray);
        if (is == wanted) continue;
        CAPTURE(box.min, box.max, ray);
        REQUIRE(words(is) == words(wanted));
    }
    for (const std::size_t rays : passes) CHECK(rays > sized(500u, 50u));
    CHECK(in_planes > sized(500u, 50u));
}
