#include "ex03_front_faces.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <array>
#include <vector>

using namespace space;

namespace {

using Indices = std::vector<std::uint32_t>;

/// In the plane z = 0, front side towards +z.
constexpr Triangle facing_up{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
constexpr Triangle facing_down{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};

/// An octahedron around the origin, each face's front outwards.
std::vector<Triangle> octahedron() {
    std::vector<Triangle> faces;
    for (const float x : {-1.0f, 1.0f})
        for (const float y : {-1.0f, 1.0f})
            for (const float z : {-1.0f, 1.0f}) {
                const Point3 a(x, 0, 0), b(0, y, 0), c(0, 0, z);
                faces.push_back(x * y * z > 0 ? Triangle{a, b, c} : Triangle{a, c, b});
            }
    return faces;
}

}  // namespace

TEST_CASE("the vertex order decides which side is the front") {
    const Camera above{.eye = {0, 0, 5}, .target = {0, 0, 0}},
        below{.eye = {0, 0, -5}, .target = {0, 0, 0}};
    CHECK(front_faces(std::array{facing_up, facing_down}, above) == Indices{0});
    CHECK(front_faces(std::array{facing_up, facing_down}, below) == Indices{1});
}

TEST_CASE("a triangle seen edge-on shows neither side") {
    const Camera in_plane{.eye = {7, 3, 0}, .target = {0, 0, 0}};
    CHECK(front_faces(std::array{facing_up, facing_down}, in_plane).empty());
}

TEST_CASE("where the camera looks does not matter, only where its eye is") {
    // The triangle stands at the picture's border: its plane lies behind the target, but the eye is
    // in front of it.
    const Triangle tilted{{10, -1, 0}, {10, 1, 0}, {12, 0, -3}};
    const bool eye_in_front = glm::dot(normal(tilted), Double3(0, 0, 5) - Double3(tilted.a)) > 0.0;
    for (const Point3 target :
         {Point3(0, 0, 0), Point3(10, 0, 0), Point3(-10, 0, -3), Point3(0, 0, 9)}) {
        const Camera camera{.eye = {0, 0, 5}, .target = target};
        CHECK(front_faces(std::array{tilted}, camera) == (eye_in_front ? Indices{0} : Indices{}));
    }
}

TEST_CASE("an octahedron shows one face, two or four, as the eye moves") {
    const std::vector<Triangle> faces = octahedron();
    // A face x + y + z = 1 is seen from eyes with x + y + z > 1, with the signs of its octant.
    CHECK(front_faces(faces, {.eye = {0.5f, 0.5f, 0.5f}, .target = {0, 0, 0}}) == Indices{7});
    CHECK(front_faces(faces, {.eye = {0, 0, 5}, .target = {0, 0, 0}}) == Indices{1, 3, 5, 7});
    CHECK(front_faces(faces, {.eye = {0, 0.75f, 0.75f}, .target = {0, 0, 0}}) == Indices{3, 7});
}

TEST_CASE("from inside, a body shows no front") {
    CHECK(front_faces(octahedron(), {.eye = {0.1f, 0.1f, 0.1f}, .target = {5, 0, 0}}).empty());
}

TEST_CASE("the eye's side is right for tiny triangles, and for an eye close to their planes") {
    Pcg32 random(13);
    const auto whole = [&] { return static_cast<std::int64_t>(random.below(16385)) - 8192; };
    for (int i = 0; i < 20'000; ++i) {
        // In whole numbers, so that the side is known: the eye is one step off a point of the
        // plane.
        std::int64_t a[3], b[3], c[3], eye[3];
        for (int k = 0; k < 3; ++k) a[k] = whole();
        for (int k = 0; k < 3; ++k) b[k] = whole();
        for (int k = 0; k < 3; ++k) c[k] = whole();
        for (int k = 0; k < 3; ++k) eye[k] = 2 * b[k] - a[k] + (c[k] - a[k]);
        eye[i % 3] += i % 2 ? 1 : -1;
        std::int64_t volume = 0;
        for (int k = 0, l = 1, m = 2; k < 3; ++k, l = (l + 1) % 3, m = (m + 1) % 3)
            volume +=
                ((b[l] - a[l]) * (c[m] - a[m]) - (b[m] - a[m]) * (c[l] - a[l])) * (eye[k] - a[k]);
        const float size = std::ldexp(1.0f, -static_cast<int>(random.below(31)));
        const auto point = [&](const std::int64_t* p) { return size * Point3(p[0], p[1], p[2]); };
        const Triangle triangle{point(a), point(b), point(c)};
        const Camera camera{.eye = point(eye), .target = point(a)};
        CAPTURE(triangle, camera.eye);
        REQUIRE(front_faces(std::array{triangle}, camera) == (volume > 0 ? Indices{0} : Indices{}));
    }
}
