#include "chapters/ch11_sampling_and_caching/spherical_triangle.hpp"

#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"
#include "tests/ch11/up.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace space {
namespace {

using Long3 = glm::vec<3, long double>;

/// In 64-bit precision, of a corner as a vector from the point that sees it, and its edges.
long double exact_solid_angle(const Long3& a, const Long3& ab, const Long3& ac) {
    const Long3 b = a + ab, c = a + ac;
    const long double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2.0L * std::atan2(std::abs(glm::dot(a, glm::cross(ab, ac))),
                             la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la +
                                 glm::dot(c, a) * lb);
}

/// As spherical trigonometry has it (Girard): the angles' sum, less pi.
double solid_angle_by_angles(const SphericalTriangle& t) {
    const auto angle = [](const Double3& at, const Double3& p, const Double3& q) {
        const Double3 n = glm::normalize(glm::cross(at, p)), m = glm::normalize(glm::cross(at, q));
        return std::acos(std::clamp(glm::dot(n, m), -1.0, 1.0));
    };
    return angle(t.a, t.b, t.c) + angle(t.b, t.c, t.a) + angle(t.c, t.a, t.b) - std::numbers::pi;
}

/// The part of v at right angles to the unit vector `to`, of length 1.
Double3 beside(const Double3& v, const Double3& to) {
    return glm::normalize(v - glm::dot(v, to) * to);
}

/// Arvo 1995, figure 4: a direction.
Double3 published_sample(const SphericalTriangle& t, const Double2& u) {
    const Double3 a = glm::normalize(t.a), b = glm::normalize(t.b), c = glm::normalize(t.c);
    const double alpha = std::acos(std::clamp(
        glm::dot(glm::normalize(glm::cross(a, b)), glm::normalize(glm::cross(a, c))), -1.0, 1.0));
    const double phi = u.x * solid_angle_by_angles(t) - alpha;
    const double s = std::sin(phi), cosine = std::cos(phi);
    const double p = cosine - std::cos(alpha), v = s + std::sin(alpha) * glm::dot(a, b);
    const double q =
        ((v * cosine - p * s) * std::cos(alpha) - v) / ((v * s + p * cosine) * std::sin(alpha));
    const Double3 to = q * a + std::sqrt(std::max(0.0, 1.0 - q * q)) * beside(c, a);
    const double z = 1.0 - u.y * (1.0 - glm::dot(to, b));
    return z * b + std::sqrt(std::max(0.0, 1.0 - z * z)) * beside(to, b);
}

/// A triangle and the point that sees it.
struct View {
    const char* name;
    Triangle triangle;
    Double3 point;
};

/// Of this size around the world's origin, where floats are as fine as it needs.
Triangle sized_triangle(float size) {
    return {size * Point3(1.0f, 0.1f, 0.2f), size * Point3(-0.5f, 0.9f, -0.1f),
            size * Point3(-0.4f, -0.8f, 0.3f)};
}

std::vector<View> views() {
    const Triangle flat{{-50, -40, 0}, {60, -30, 0}, {5, 70, 0}};
    return {
        {"octant", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0.0, 0.0, 0.0}},
        {"common", sized_triangle(1.0f), {0.2, -0.3, 2.0}},
        {"small", sized_triangle(1e-3f), {0.2, -0.3, 1.0}},
        {"tiny", sized_triangle(1e-6f), {0.2, -0.3, 1.0}},
        {"tiniest", sized_triangle(1e-10f), {0.2, -0.3, 1.0}},
        {"nearly a half sphere", flat, {1.0, 2.0, 0.5}},
        {"more nearly", flat, {1.0, 2.0, 1e-3}},
        {"beside a huge one", flat, {-80.0, 10.0, 1.0}},
        {"edge-on", flat, {-80.0, 10.0, 1e-4}},
        {"over an edge", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0.5, 1e-5, 1e-5}},
        {"over a corner", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {1e-6, 1e-6, 1e-5}},
        {"a sliver", {{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-4f, 0}}, {0.3, 0.4, 0.5}},
    };
}

/// All orders of the corners: the arcs are not treated alike.
std::vector<Triangle> turned(const Triangle& t) {
    return {t, {t.b, t.c, t.a}, {t.c, t.a, t.b}, {t.a, t.c, t.b}};
}

TEST_CASE("the solid angles of an octant, of a cube's faces and of a half sphere") {
    const SphericalTriangle octant({{2, 0, 0}, {0, 3, 0}, {0, 0, 5}}, Double3(0.0));
    CHECK(octant.solid_angle == Approx(0.5 * std::numbers::pi).epsilon(1e-15));
    const SphericalTriangle half_face({{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}}, Double3(0.0));
    CHECK(half_face.solid_angle == Approx(std::numbers::pi / 3.0).epsilon(1e-15));
    // Seen from its own plane: nothing from beside it, a half sphere from within.
    const Triangle flat{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    CHECK(SphericalTriangle(flat, {3.0, 0.0, 0.0}).solid_angle == 0.0);
    CHECK(SphericalTriangle(flat, {0.1, 0.1, 0.0}).solid_angle ==
          Approx(2.0 * std::numbers::pi).epsilon(1e-15));
}

TEST_CASE("a solid angle's sign of the volume tells front from back") {
    const Triangle t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};  // its front is up
    CHECK(SphericalTriangle(t, {0.2, 0.2, 1.0}).volume < 0.0);
    CHECK(SphericalTriangle(t, {0.2, 0.2, -1.0}).volume > 0.0);
}

TEST_CASE(
    "a triangle's solid angle keeps its digits at every size; the sum of its angles does not") {
    Pcg32 random(3);
    double ours = 0.0;
    for (const float size : {1.0f, 1e-2f, 1e-4f, 1e-6f, 1e-8f, 1e-12f, 1e-16f}) {
        double by_angles = 0.0;
        for (int i = 0; i < 300; ++i) {
            const Triangle t = sized_triangle(size);
            // What the rounding of the way to a corner takes from the height over the plane.
            const Double3 around = random_direction(random);
            const Double3 n = glm::normalize(normal(t));
            const double sine = std::abs(glm::dot(around, n));
            if (sine < 0.05) continue;
            const Double3 point = (2.0 + random.uniform()) * around;
            const SphericalTriangle seen(t, point);
            const Long3 a(t.a);
            const double exact = static_cast<double>(
                exact_solid_angle(a - Long3(point), Long3(t.b) - a, Long3(t.c) - a));
            ours = std::max(ours, sine * std::abs(seen.solid_angle / exact - 1.0));
            by_angles = std::max(by_angles, std::abs(solid_angle_by_angles(seen) / exact - 1.0));
        }
        CAPTURE(size, by_angles);
        if (size < 1e-5f) CHECK(by_angles > 1e-6);
        if (size < 1e-7f) CHECK(by_angles > 0.5);
    }
    CAPTURE(0x1p53 * ours);
    CHECK(ours < 0x1p-50);
}

TEST_CASE("a tiny triangle's solid angle is area times cosine over squared distance") {
    const Triangle t = sized_triangle(1e-8f);
    const Double3 point{0.3, -0.4, 1.2},
        to = (Double3(t.a) + Double3(t.b) + Double3(t.c)) / 3.0 - point;
    const double exact = 0.5 * std::abs(glm::dot(normal(t), glm::normalize(to))) / glm::dot(to, to);
    CHECK(SphericalTriangle(t, point).solid_angle == Approx(exact).epsilon(1e-14));
}

TEST_CASE("samples are where Arvo's published formulas put them, as long as those have digits") {
    Pcg32 random(5);
    double difference = 0.0, published_error = 0.0;
    for (int i = 0; i < 1'000; ++i) {
        const Double2 u = random_pair(random);
        const SphericalTriangle common(sized_triangle(1.0f), {0.2, -0.3, 2.0});
        difference =
            std::max(difference, glm::distance(glm::normalize(sample_solid_angle(common, u)),
                                               published_sample(common, u)));
        // Relative to the triangle's extent, 1e-7.
        const SphericalTriangle tiny(sized_triangle(1e-7f), {0.2, -0.3, 2.0});
        published_error = std::max(published_error,
                                   1e7 * glm::distance(glm::normalize(sample_solid_angle(tiny, u)),
                                                       published_sample(tiny, u)));
    }
    CAPTURE(difference, published_error);
    CHECK(difference < 1e-13);
    CHECK(!(published_error < 0.01));
}

constexpr int cuts = 8;

/// Which of the 64 equal triangles that cut a triangle holds the point with these coordinates.
std::size_t cell_of(double u, double v) {
    const int i = std::clamp(static_cast<int>(u * cuts), 0, cuts - 1),
              j = std::clamp(static_cast<int>(v * cuts), 0, cuts - 1 - i);
    const bool upper = u * cuts - i + v * cuts - j > 1.0 && i + j < cuts - 1;
    return static_cast<std::size_t>((i * cuts + j) * 2 + upper);
}

std::vector<double> expected_shares(const SphericalTriangle& t) {
    const Long3 a(t.a), e1 = Long3(t.b) - a, e2 = Long3(t.c) - a;
    const Long3 i_step = e1 / static_cast<long double>(cuts),
                j_step = e2 / static_cast<long double>(cuts);
    const long double all = exact_solid_angle(a, e1, e2);
    const auto share = [&](int i, int j, const Long3& ab, const Long3& ac) {
        const Long3 at =
            a + static_cast<long double>(i) * i_step + static_cast<long double>(j) * j_step;
        return static_cast<double>(exact_solid_angle(at, ab, ac) / all);
    };
    std::vector<double> shares(cuts * cuts * 2, 0.0);
    for (int i = 0; i < cuts; ++i)
        for (int j = 0; i + j < cuts; ++j) {
            const std::size_t cell = cell_of((i + 0.1) / cuts, (j + 0.1) / cuts);
            shares[cell] = share(i, j, i_step, j_step);
            if (i + j < cuts - 1) shares[cell + 1] = share(i + 1, j + 1, -i_step, -j_step);
        }
    return shares;
}

/// Chi-square of samples against `shares`, over its limit; cells where less than 5 samples are
/// expected are one cell.
template <class Sample>
double misfit(const SphericalTriangle& t, const std::vector<double>& shares, const Sample& sample) {
    const int count = sized(60'000, 6'000);
    Pcg32 random(23);
    const Double3 e1 = t.b - t.a, e2 = t.c - t.a, n = glm::cross(e1, e2);
    std::vector<std::uint64_t> observed(1);
    std::vector<double> expected(1);
    std::vector<std::size_t> cell(shares.size(), 0);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (shares[i] * count < 5.0) {
            expected[0] += shares[i] * count;
            continue;
        }
        cell[i] = expected.size();
        expected.push_back(shares[i] * count);
        observed.push_back(0);
    }
    for (int i = 0; i < count; ++i) {
        const Double3 s = sample(t, random_pair(random)) - t.a;
        const double u = glm::dot(glm::cross(s, e2), n) / glm::dot(n, n),
                     v = glm::dot(glm::cross(e1, s), n) / glm::dot(n, n);
        const double slack = 1e-14 * glm::length(t.a) / std::sqrt(glm::length(n)) + 1e-9;
        REQUIRE((u > -slack && v > -slack && u + v < 1.0 + 2.0 * slack));
        ++observed[cell[cell_of(u, v)]];
    }
    if (expected[0] < 5.0) {  // too few even together: a wrong sampler would put many there
        if (observed[0] > 25) return 1e9;
        expected[0] = static_cast<double>(observed[0]);
    }
    return chi_square(observed, expected) / chi_square_limit(expected.size());
}

TEST_CASE("a triangle's samples are uniform in solid angle, whatever its size and place") {
    for (const View& view : views())
        for (const Triangle& triangle : turned(view.triangle)) {
            CAPTURE(view.name);
            const SphericalTriangle seen(triangle, view.point);
            CHECK(misfit(seen, expected_shares(seen), sample_solid_angle) < 1.0);
        }
}

TEST_CASE("samples uniform in area are caught where they are not uniform in solid angle") {
    const auto by_area = [](const SphericalTriangle& t, const Double2& u) {
        return glm::mix(t.b, glm::mix(t.a, t.c, u.x), std::sqrt(u.y));
    };
    const View common = views()[1], tiny = views()[3];
    const SphericalTriangle seen(common.triangle, common.point), far(tiny.triangle, tiny.point);
    CHECK(misfit(seen, expected_shares(seen), by_area) > 2.0);
    CHECK(misfit(far, expected_shares(far), by_area) < 1.0);  // there is no difference any more
}

TEST_CASE("the ends of the unit square, and points in the triangle's plane, give finite samples") {
    std::vector<View> all = views();
    const Triangle flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const double height : {1e-7, 1e-12, 1e-300})
        for (const Double3& at :
             {Double3(0.25, 0.25, height), Double3(0.5, 0.0, height), Double3(0.5, 0.5, height),
              Double3(0.0, 0.0, height), Double3(2.0, 0.0, height), Double3(-1.0, 0.0, height)})
            all.push_back({"in the plane", flat, at});
    const double last = 1.0 - 0x1p-53;
    for (const View& view : all)
        for (const Triangle& triangle : turned(view.triangle)) {
            const SphericalTriangle seen(triangle, view.point);
            REQUIRE((seen.solid_angle >= 0.0 && seen.solid_angle <= 2.0 * std::numbers::pi));
            if (seen.solid_angle == 0.0) continue;
            for (const double x : {0.0, 1e-300, 0.5, last})
                for (const double y : {0.0, 1e-300, 0.5, last}) {
                    CAPTURE(view.name, view.point.x, view.point.y, view.point.z, x, y);
                    const Double3 p = sample_solid_angle(seen, {x, y});
                    REQUIRE(std::isfinite(p.x + p.y + p.z));
                }
        }
}

}  // namespace
}  // namespace space
