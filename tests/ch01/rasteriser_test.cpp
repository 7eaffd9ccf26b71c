#include "chapters/ch01_naive_ray_tracing/rasteriser.hpp"

#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"

#include <numbers>

using namespace space;

namespace {

/// Its image plane at distance 1 reaches from -1 to 1 on both axes: 16 x 16 pixels of 1/8.
const Camera square_camera{.eye = {0, 0, 0}, .target = {0, 0, -1}, .field_of_view = 90.0f};

DepthBuffer draw(std::initializer_list<Triangle> triangles, int size = 16,
                 const Camera& camera = square_camera) {
    Rasteriser rasteriser({camera, size, size});
    std::uint32_t index = 0;
    for (const Triangle& triangle : triangles) rasteriser.draw(triangle, index++);
    return rasteriser.buffer();
}

std::size_t covered(const DepthBuffer& buffer) {
    return static_cast<std::size_t>(std::count_if(buffer.pixels.begin(), buffer.pixels.end(),
                                                  [](const Hit& hit) { return hit.t < infinity; }));
}

}  // namespace

TEST_CASE("the pixels of a triangle are those whose centre lies in it, its sides included") {
    // In pixels: (4, 4), (12, 4), (4, 12): the hypotenuse x + y = 16 passes through centres, which
    // are covered.
    const DepthBuffer buffer = draw({{{-0.5f, 0.5f, -1}, {-0.5f, -0.5f, -1}, {0.5f, 0.5f, -1}}});
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            INFO("pixel " << x << " " << y);
            CHECK((buffer.at(x, y).t < infinity) ==
                  (x >= 4 && y >= 4 && (x + 0.5) + (y + 0.5) <= 16.0));
        }
    CHECK(buffer.at(4, 4).t == 1.0f);
}

TEST_CASE("depth and barycentric coordinates are those of the ray through the pixel's centre") {
    const Triangle slanted{{-3, -2, -2}, {4, -1, -9}, {0, 5, -4}};
    const DepthBuffer buffer = draw({slanted}, 64);
    const PixelGrid grid(square_camera, 64, 64);
    int compared = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const auto hit = MollerTrumbore::intersect(grid.ray(x, y), slanted);
            if (!hit || buffer.at(x, y).t == infinity) continue;
            ++compared;
            CHECK(buffer.at(x, y).t == Approx(hit->t).epsilon(1e-6));
            CHECK(std::abs(buffer.at(x, y).u - hit->u) < 1e-6f);
            CHECK(std::abs(buffer.at(x, y).v - hit->v) < 1e-6f);
        }
    CHECK(compared > 500);
}

TEST_CASE("the nearest triangle is kept, whatever the order of drawing") {
    const Triangle near{{-1, -1, -2}, {1, -1, -2}, {0, 1, -2}},
        far{{-9, -9, -4}, {9, -9, -4}, {0, 9, -4}};
    const DepthBuffer one = draw({near, far}), other = draw({far, near});
    CHECK(one.at(8, 8).triangle == 0);
    CHECK(other.at(8, 8).triangle == 1);
    for (std::size_t i = 0; i < one.pixels.size(); ++i) CHECK(one.pixels[i].t == other.pixels[i].t);
}

TEST_CASE("of equal depth the smaller index wins") {
    const Triangle triangle{{-1, -1, -2}, {1, -1, -2}, {0, 1, -2}};
    const DepthBuffer buffer = draw({triangle, triangle, triangle});
    CHECK(covered(buffer) > 0);
    for (const Hit& hit : buffer.pixels) CHECK(hit.triangle == 0);
}

TEST_CASE("what is behind the eye or in its plane is not drawn") {
    CHECK(covered(draw({{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}})) == 0);
    CHECK(covered(draw({{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}})) == 0);
    CHECK(covered(draw({{{0, -1, -1}, {0, 1, -1}, {0, 0, -4}}})) ==
          0);  // edge-on: the eye is in its plane
}

TEST_CASE("a triangle that reaches behind the eye is cut, not turned inside out") {
    // A floor at y = -1 from far behind to far ahead: it fills the lower half of the picture.
    const DepthBuffer buffer = draw({{{-1000, -1, 900}, {1000, -1, 900}, {0, -1, -1e6f}}});
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) CHECK((buffer.at(x, y).t < infinity) == (y >= 8));
    CHECK(buffer.at(8, 15).t ==
          Approx(16.0 / 15.0));  // seen at 15/16 of the way down the image plane
}

TEST_CASE(
    "what lies before the near plane is not drawn, though it has a projection within the picture") {
    constexpr float e = 0x1p-11f;  // half the near plane's depth
    CHECK(covered(draw({{{-e, -e, -e}, {e, -e, -e}, {0, e, -e}}})) == 0);
    // From the near plane's wrong side at the picture's centre down to its lower corners: the part
    // that the plane cuts off reaches half the way down.
    const DepthBuffer buffer = draw({{{0, 0, -e}, {-1, -1, -1}, {1, -1, -1}}});
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            INFO("pixel " << x << " " << y);
            CHECK((buffer.at(x, y).t < infinity) == (y >= 12 && x >= 15 - y && x <= y));
            CHECK(buffer.at(x, y).t >= near_fraction);
        }
}

TEST_CASE("no pixel falls between two triangles with a common edge") {
    // A fan around the picture's centre whose rim lies outside the picture, with irrational
    // corners.
    Pcg32 random(5);
    for (int round = 0; round < 20; ++round) {
        Rasteriser rasteriser({square_camera, 61, 61});
        const Point3 hub(random_point(random, Aabb2{Point2(-0.4f), Point2(0.4f)}), -1.0f);
        constexpr int corners = 23;
        std::vector<Point3> rim;
        for (int i = 0; i < corners; ++i) {
            const double angle =
                2.0 * std::numbers::pi * (i + 0.5 * random.uniform_double()) / corners;
            const double depth_of_corner = 1.0 + random.uniform_double();
            rim.emplace_back(3 * std::cos(angle) * depth_of_corner,
                             3 * std::sin(angle) * depth_of_corner, -depth_of_corner);
        }
        for (int i = 0; i < corners; ++i) rasteriser.draw({hub, rim[i], rim[(i + 1) % corners]}, i);
        CHECK(covered(rasteriser.buffer()) == 61 * 61);
    }
}

TEST_CASE("ray tracer and rasteriser differ only within the stated distance of an edge") {
    constexpr int width = sized(80, 24), height = sized(60, 18);
    std::uint64_t near_edge = 0;
    for (const SceneRecipe& recipe : scene_recipes()) {
        if (recipe.from_file) continue;  // which need not be there
        const Scene scene = make_scene(recipe.name, 1, true);
        const Naive<> naive = Naive<>::build(scene.mesh.triangles());
        const Coverage coverage =
            compare_coverage(scene, trace_depth({scene.camera, width, height}, naive, 2),
                             rasterise(scene, width, height));
        INFO(recipe.name << ": " << coverage.disagree << " pixels disagree, farthest "
                         << coverage.farthest);
        if (recipe.name != "dust") CHECK(coverage.covered > 0);  // it may lie between the rays
        CHECK(coverage.unexplained == 0);
        CHECK(coverage.farthest <= coverage_distance({scene.camera, width, height}));
        near_edge += coverage.near_edge;
    }
    CHECK(near_edge > 0);  // the comparison can see a difference at all
}

TEST_CASE("from inside a soup, with triangles on all sides of the eye, the renderers still agree") {
    Scene scene = make_scene("soup:500", 9);
    scene.camera.eye = bounds(scene.mesh).centroid();
    const Naive<> naive = Naive<>::build(scene.mesh.triangles());
    const Coverage coverage = compare_coverage(
        scene, trace_depth({scene.camera, 120, 90}, naive, 2), rasterise(scene, 120, 90));
    CHECK(coverage.covered > 1000);
    CHECK(coverage.unexplained == 0);
}

TEST_CASE("a pixel that is wrong far from every edge is found") {
    const Scene scene = make_scene("icosphere:4");
    const Naive<> naive = Naive<>::build(scene.mesh.triangles());
    const DepthBuffer traced = trace_depth({scene.camera, 400, 400}, naive, 2);
    DepthBuffer broken = rasterise(scene, 400, 400);
    broken.at(200, 200) = {};
    CHECK(compare_coverage(scene, traced, broken).unexplained == 1);
}

TEST_CASE("the rasterised picture is the ray-traced one without shadows") {
    const Scene scene = make_scene("icosphere:3");
    const Naive<> naive = Naive<>::build(scene.mesh.triangles());
    const PixelGrid grid(scene.camera, 40, 30);
    const DepthBuffer buffer = rasterise(scene, 40, 30);
    const Image image = render_rasterised(scene, 40, 30);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const Ray ray = grid.ray(x, y);
            const auto hit = closest_hit(naive, ray);
            if (!hit || hit->triangle != buffer.at(x, y).triangle) continue;
            const Color color = shade(scene, ray, *hit, [](const Ray&) { return true; });
            CHECK(glm::distance(image.at(x, y), color) <= 1e-5f * (1.0f + glm::length(color)));
        }
}
