#include "ex01_one_root_fewer.hpp"

#include "common/random.hpp"
#include "tests/catch.hpp"

#include <cmath>

using namespace space;

namespace {

struct Counted {
    Weights weights;
    int roots;
};
Counted counted(const Vector3& of_b, const Vector3& of_c, const Vector3& n) {
    int roots = 0;
    const Weights result = weights(of_b, of_c, n, [&](float x) {
        ++roots;
        return std::sqrt(x);
    });
    return {result, roots};
}

}  // namespace

TEST_CASE("the weights of a triangle in a coordinate plane come out by hand") {
    const Counted halves = counted({0, 0, 4}, {0, 0, 2}, {0, 0, 8});
    CHECK(halves.weights.u == 0.5f);
    CHECK(halves.weights.v == 0.25f);
    const Counted corner = counted({0, 0, 0}, {0, 3, 0}, {0, 3, 0});
    CHECK(corner.weights.u == 0.0f);
    CHECK(corner.weights.v == 1.0f);
}

TEST_CASE("two square roots are enough") {
    CHECK(counted({1, 2, 2}, {2, 4, 4}, {4, 8, 8}).roots <= 2);
}

TEST_CASE("the weights are right to within four roundings for normals of any length") {
    Pcg32 random(21);
    for (int i = 0; i < 1000; ++i) {
        const float length = std::ldexp(1.0f, static_cast<int>(random.below(20)) - 10);
        const Vector3 n = length * random_point(random, Aabb{{-1, -1, 1}, {1, 1, 2}});
        const float u = random.uniform(), v = random.uniform();
        const Weights result = counted(u * n, v * n, n).weights;
        CHECK(std::abs(result.u - u) <= 8 * 0x1p-24f * u);
        CHECK(std::abs(result.v - v) <= 8 * 0x1p-24f * v);
    }
}
