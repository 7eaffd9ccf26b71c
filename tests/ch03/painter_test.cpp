// The painter's order, the z-buffer and the naive loop show the same triangle in every pixel; and
// what counts their differences counts them.
#include "chapters/ch03_bsp_trees/painter.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"

namespace space {
namespace {

constexpr int width = 40, height = 30;

/// From outside and from among the triangles, where some lie behind the eye or across its plane.
std::vector<Camera> cameras() {
    return {{.eye = {2.5f, 1, 2}, .target = {0, 0, 0}},
            {.eye = {-0.2f, 0.1f, 0.3f}, .target = {1, 0.5f, 0}, .field_of_view = 90},
            {.eye = {0, -3, 0.1f}, .target = {0.1f, 0, 0}, .up = {0, 0, 1}}};
}

/// Three long triangles, each over the next: no order of whole triangles is right.
std::vector<Triangle> ring() {
    return {{{-3, -1, 0}, {3, -1, 1}, {3, -0.5f, 1}},
            {{1, -3, 0}, {1, 3, 1}, {0.5f, 3, 1}},
            {{2, 2, 0}, {-2, -2.5f, 1}, {-2.2f, -2, 1}}};
}
const Camera above_ring{.eye = {0, 0, 9}, .target = {0, 0, 0}};

DepthBuffer traced(const std::vector<Triangle>& triangles, const Camera& camera) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    const CameraFrame frame(camera);
    DepthBuffer picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Ray ray = camera_ray(camera, frame, x + 0.5, y + 0.5, width, height);
            picture.at(x, y) = closest_hit(naive, ray).value_or(Hit{});
        }
    return picture;
}

}  // namespace

TEST_CASE("the z-buffer shows in every pixel the hit that the naive loop finds") {
    const std::vector<Triangle> triangles = scenes::soup(60, 0.6f, 1);
    for (const Camera& camera : cameras()) {
        const DepthBuffer shown = z_buffer(triangles, {camera, width, height}),
                          truth = traced(triangles, camera);
        int covered = 0, other = 0;
        for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
            covered += truth.pixels[i].t < infinity;
            other += shown.pixels[i] != truth.pixels[i];
        }
        CHECK(covered > width * height / 10);
        CHECK(other == 0);
    }
}

TEST_CASE("the painter shows in every pixel what the z-buffer shows, from any eye") {
    const std::vector<Triangle> soup = scenes::soup(60, 0.6f, 1);
    for (const Grade grade : {Grade::ordered_double, Grade::exact}) {
        const BspTree<3> tree = BspBuilder<3>::build(soup, {.grade = grade});
        CHECK(tree.fragments.size() > 2 * soup.size());
        for (const Camera& camera : cameras()) {
            const PixelDifferences d =
                pixel_differences(paint(tree, grade, {camera, width, height}),
                                  z_buffer(soup, {camera, width, height}));
            CHECK(d.pixels == width * height);
            CHECK(d.covered > width * height / 10);
            CHECK(d.wrong == 0);
        }
    }
}

TEST_CASE("a ring of triangles is painted right in pieces, and wrong in whole triangles") {
    const DepthBuffer truth = z_buffer(ring(), {above_ring, width, height});
    const auto painted = [&](BspConfig::Straddlers straddlers) {
        const BspTree<3> tree = BspBuilder<3>::build(ring(), {.straddlers = straddlers});
        return pixel_differences(paint(tree, Grade::exact, {above_ring, width, height}), truth);
    };
    CHECK(painted(BspConfig::Straddlers::split).wrong == 0);
    CHECK(painted(BspConfig::Straddlers::share).wrong > 0);
}

TEST_CASE("a fragment is painted in its own pixels only, by its triangle's hit") {
    const std::vector<Triangle> one{{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}};
    const Camera camera{.eye = {0, 0, 3}, .target = {0, 0, 0}};
    const std::vector<Triangle> with_knife{{{0, 5, -1}, {0, 6, -1}, {0, 5, 1}}, one[0]};
    const std::uint32_t order[] = {0};  // its plane x = 0 cuts the triangle
    const BspTree<3> tree = BspBuilder<3>::build(with_knife, {.order = order});
    const FragmentRays covers(tree, Grade::exact);
    int halves = 0, left = 0, right = 0;
    for (const Fragment<3>& fragment : tree.fragments) {
        if (fragment.polygon != 1) continue;
        ++halves;
        int here = 0, beyond = 0;
        for_pixels_of(fragment, tree, covers, {camera, width, height},
                      [&](int x, int, const Ray& ray, const Hit& hit) {
                          ++(x < width / 2 ? left : right);
                          ++here;
                          beyond +=
                              !covers.meets(ray, fragment) || hit.triangle != 1 || hit.t <= 0.0f;
                      });
        CHECK(here > 0);
        CHECK(beyond == 0);
    }
    CHECK(halves == 2);
    CHECK(left == right);
    int whole = 0;
    for (const Hit& hit : traced(one, camera).pixels) whole += hit.t < infinity;
    CHECK(left + right == whole);
}

TEST_CASE("differences tell a tie from another triangle, and from none") {
    DepthBuffer one(4, 1), other(4, 1);
    one.at(0, 0) = other.at(0, 0) = {.t = 2.0f, .triangle = 3};
    one.at(1, 0) = {.t = 2.0f, .triangle = 3};
    other.at(1, 0) = {.t = std::nextafter(2.0f, 3.0f), .triangle = 4};
    one.at(2, 0) = {.t = 2.0f, .triangle = 3};
    other.at(2, 0) = {.t = 2.001f, .triangle = 4};
    one.at(3, 0) = {.t = 2.0f, .triangle = 0};  // the triangle that an empty pixel names, too
    const PixelDifferences d = pixel_differences(one, other),
                           turned = pixel_differences(other, one);
    CHECK(d.pixels == 4);
    CHECK(d.covered == 4);
    CHECK(d.same_depth == 1);
    CHECK(d.wrong == 2);
    CHECK(turned.covered == 3);
    CHECK(turned.wrong == 2);
}

TEST_CASE("a picture shows the background where nothing is, and light where something is") {
    Scene scene;
    scene.mesh.vertices = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    scene.mesh.faces = {{0, 1, 2}};
    scene.camera = {.eye = {0, 0, 3}, .target = {0, 0, 0}};
    scene.background = Color(0.25f, 0.5f, 0.75f);
    scene.lights = {{{0, 0, 3}, Color(9.0f)}};
    const DepthBuffer shown = z_buffer(scene.mesh.triangles(), {scene.camera, width, height});
    const Image image = picture_of(scene, shown);
    CHECK(image.at(0, 0) == scene.background);
    CHECK(image.at(width / 2, height / 2) != scene.background);
    CHECK(image.at(width / 2, height / 2).r > 0.0f);
}

}  // namespace space
