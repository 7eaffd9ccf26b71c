#include "common/random.hpp"
#include "tests/check.hpp"

#include <cmath>
#include <limits>

namespace {

/// A float that counts square roots, in whichever way they are asked for. It turns into no float,
/// so that nothing else takes its root.
struct CountingFloat {
    float value = 0.0f;

    CountingFloat() = default;
    CountingFloat(float x) : value(x) {}
    CountingFloat& operator+=(CountingFloat x) { return *this = value + x.value; }
    CountingFloat& operator-=(CountingFloat x) { return *this = value - x.value; }
    CountingFloat& operator*=(CountingFloat x) { return *this = value * x.value; }
    CountingFloat& operator/=(CountingFloat x) { return *this = value / x.value; }
    friend CountingFloat operator+(CountingFloat a, CountingFloat b) { return a += b; }
    friend CountingFloat operator-(CountingFloat a, CountingFloat b) { return a -= b; }
    friend CountingFloat operator*(CountingFloat a, CountingFloat b) { return a *= b; }
    friend CountingFloat operator/(CountingFloat a, CountingFloat b) { return a /= b; }
    friend CountingFloat operator-(CountingFloat a) { return -a.value; }
    friend auto operator<=>(CountingFloat, CountingFloat) = default;
};
int roots = 0;
CountingFloat sqrt(CountingFloat x) {
    ++roots;
    return std::sqrt(x.value);
}
[[maybe_unused]] CountingFloat inversesqrt(CountingFloat x) {
    return 1.0f / sqrt(x);
}
[[maybe_unused]] CountingFloat abs(CountingFloat x) {
    return std::abs(x.value);
}

}  // namespace

template <>
struct std::numeric_limits<CountingFloat> : std::numeric_limits<float> {};  // glm asks

#include "ex01_one_root_fewer.hpp"

using namespace space;

namespace {

struct Counted {
    float u, v;
    int roots;
};
Counted counted(const Vector3& of_b, const Vector3& of_c, const Vector3& n) {
    using Counting = glm::vec<3, CountingFloat>;
    roots = 0;
    const auto [u, v] =
        weights<CountingFloat>(Counting(of_b.x, of_b.y, of_b.z), Counting(of_c.x, of_c.y, of_c.z),
                               Counting(n.x, n.y, n.z));
    return {u.value, v.value, roots};
}

}  // namespace

TEST_CASE("the weights of a triangle in a coordinate plane come out by hand") {
    const Counted halves = counted({0, 0, 4}, {0, 0, 2}, {0, 0, 8});
    CHECK(halves.u == 0.5f);
    CHECK(halves.v == 0.25f);
    const Counted corner = counted({0, 0, 0}, {0, 3, 0}, {0, 3, 0});
    CHECK(corner.u == 0.0f);
    CHECK(corner.v == 1.0f);
}

TEST_CASE("two square roots are enough") {
    CHECK(counted({1, 2, 2}, {2, 4, 4}, {4, 8, 8}).roots <= 2);
}

TEST_CASE("the weights are right to within eight roundings for normals of any length") {
    Pcg32 random(21);
    for (int i = 0; i < 1000; ++i) {
        const float length = std::ldexp(1.0f, static_cast<int>(random.below(20)) - 10);
        const Vector3 n = length * random_point(random, Aabb{{-1, -1, 1}, {1, 1, 2}});
        const float u = random.uniform(), v = random.uniform();
        const Counted result = counted(u * n, v * n, n);
        CAPTURE(n, Number{u}, Number{v}, Number{result.u}, Number{result.v});
        REQUIRE(Error{std::abs(result.u - u), 8 * 0x1p-24f * u});
        REQUIRE(Error{std::abs(result.v - v), 8 * 0x1p-24f * v});
    }
}
