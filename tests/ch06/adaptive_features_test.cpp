// What adaptive sampling misses, what it can't miss, and chapter 1's room by it.

#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/adaptive_sampling.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace space;

namespace {

using Evidence = AdaptiveConfig::Evidence;

/// Surface 0 is black, surface s > 0 a grey of its own.
PictureSample flat(std::uint32_t surface) {
    return {Color(float(surface) / 8.0f), surface};
}

/// A picture of flat surfaces.
struct FlatPicture {
    int width, height;
    std::function<std::uint32_t(int x, int y)> surface;

    AdaptivePicture sampled(const AdaptiveConfig& config) const {
        return adaptive_picture(width, height, config,
                                [&](int x, int y) { return flat(surface(x, y)); });
    }
    std::size_t wrong_pixels(const AdaptivePicture& picture) const {
        std::size_t wrong = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                wrong += picture.image.at(x, y) != flat(surface(x, y)).color;
        return wrong;
    }
};

bool is_traced(const AdaptivePicture& picture, int x, int y) {
    return picture.traced[std::size_t(y) * std::size_t(picture.image.width()) + std::size_t(x)];
}

FlatPicture pole(int left, int width) {
    return {64, 64, [=](int x, int) { return std::uint32_t(x >= left && x < left + width); }};
}
/// A wire, a pixel wide, that falls from the left border to the right one, through (16, 16).
FlatPicture wire() {
    return {64, 64, [](int x, int y) { return std::uint32_t(y == 6 + (2 * x) / 3); }};
}
FlatPicture disc(double x0, double y0, double radius, int size) {
    return {size, size,
            [=](int x, int y) { return std::uint32_t(std::hypot(x - x0, y - y0) <= radius); }};
}

}  // namespace

TEST_CASE("what lies between the samples is not there: a pole of 15 pixels and cells of 16") {
    for (const Evidence evidence : {Evidence::corners, Evidence::all_samples}) {
        const FlatPicture full = pole(17, 15);
        const AdaptivePicture picture = full.sampled({.evidence = evidence, .first_cell = 16});
        CHECK(picture.rays == 25);
        CHECK(full.wrong_pixels(picture) == 15 * 64);
    }
}

TEST_CASE("cure: first cells no larger than the pole is wide, wherever it stands") {
    for (const int width : {1, 2, 4, 8})
        for (int left = 0; left + width <= 64; ++left) {
            CAPTURE(width, left);
            const FlatPicture full = pole(left, width);
            CHECK(full.wrong_pixels(full.sampled({.threshold = 0, .first_cell = width})) == 0);
        }
}

TEST_CASE("a wire is seen in pieces by its cells' corners, and followed by all samples") {
    const FlatPicture full = wire();
    const AdaptivePicture pieces = full.sampled({.evidence = Evidence::corners, .first_cell = 16});
    const AdaptivePicture whole = full.sampled({.first_cell = 16});
    CHECK(full.wrong_pixels(pieces) > 20);
    CHECK(full.wrong_pixels(pieces) < 64);  // some of it is seen
    CHECK(full.wrong_pixels(whole) == 0);
    CHECK(whole.rays < 64 * 64 / 4);
}

TEST_CASE("an edge between surfaces that is touched once is traced as far as it goes") {
    // In each square of 2 x 2 pixels: where two that lie side by side are traced and show different
    // surfaces, all four are traced.
    Pcg32 random(1);
    std::size_t squares = 0;
    for (int round = 0; round < sized(400, 40); ++round) {
        const int width = 2 + int(random.below(60)), height = 2 + int(random.below(60));
        std::vector<double> discs;
        for (int i = 0; i < 12; ++i) discs.push_back(64.0 * random.uniform_double());
        const FlatPicture full{
            width, height, [&](int x, int y) {
                std::uint32_t top = 0;
                for (std::uint32_t i = 0; i < 4; ++i)
                    if (std::hypot(x - discs[3 * i], y - discs[3 * i + 1]) < 0.4 * discs[3 * i + 2])
                        top = i + 1;
                return top;
            }};
        const AdaptivePicture picture = full.sampled(
            {.threshold = int(random.below(2)) * 255, .first_cell = 1 << random.below(6)});
        for (int y = 0; y + 1 < height; ++y)
            for (int x = 0; x + 1 < width; ++x) {
                const auto is_crack = [&](int x1, int y1, int x2, int y2) {
                    return is_traced(picture, x1, y1) && is_traced(picture, x2, y2) &&
                           full.surface(x1, y1) != full.surface(x2, y2);
                };
                if (!is_crack(x, y, x + 1, y) && !is_crack(x, y + 1, x + 1, y + 1) &&
                    !is_crack(x, y, x, y + 1) && !is_crack(x + 1, y, x + 1, y + 1))
                    continue;
                ++squares;
                CAPTURE(round, x, y);
                REQUIRE((is_traced(picture, x, y) && is_traced(picture, x + 1, y) &&
                         is_traced(picture, x, y + 1) && is_traced(picture, x + 1, y + 1)));
            }
    }
    CHECK(squares > 1000);
}

TEST_CASE(
    "a disc that holds a square of a first cell's size is drawn without a fault; by corners "
    "alone it is not") {
    Pcg32 random(2);
    std::size_t wrong_by_corners = 0;
    for (int round = 0; round < sized(300, 40); ++round) {
        const int edge = 2 << random.below(4);
        const double radius = edge * (0.75 + random.uniform_double());
        const int size = 80;
        const double x = radius + (size - 1 - 2 * radius) * random.uniform_double();
        const double y = radius + (size - 1 - 2 * radius) * random.uniform_double();
        const FlatPicture full = disc(x, y, radius, size);
        CAPTURE(edge, x, y, radius);
        REQUIRE(full.wrong_pixels(full.sampled({.first_cell = edge})) == 0);
        wrong_by_corners +=
            full.wrong_pixels(full.sampled({.evidence = Evidence::corners, .first_cell = edge}));
    }
    CHECK(wrong_by_corners > 0);
}

TEST_CASE("all samples tell at least what the corners tell: no traced pixel less") {
    Pcg32 random(3);
    for (int round = 0; round < sized(300, 40); ++round) {
        const double x = 60.0 * random.uniform_double(), y = 60.0 * random.uniform_double();
        const FlatPicture full = disc(x, y, 30.0 * random.uniform_double(), 61);
        AdaptiveConfig config{.first_cell = 1 << random.below(6)};
        const AdaptivePicture all = full.sampled(config);
        config.evidence = Evidence::corners;
        const AdaptivePicture corners = full.sampled(config);
        for (std::size_t i = 0; i < all.traced.size(); ++i)
            REQUIRE((all.traced[i] || !corners.traced[i]));
    }
}

TEST_CASE("an observer is told every ray and every cell, wave by wave") {
    struct Waves {
        std::size_t waves = 0, cells = 0, pixels = 0;
        void observe(const SamplingWave& wave) {
            ++waves;
            cells += wave.cells.size();
            pixels += wave.traced.size();
        }
    } seen;
    const FlatPicture full = wire();
    const AdaptivePicture picture = adaptive_picture(
        64, 64, {}, [&](int x, int y) { return flat(full.surface(x, y)); }, seen);
    CHECK(seen.waves == picture.waves);
    CHECK(seen.pixels == picture.rays);
    CHECK(seen.cells > picture.cells.size());
}

TEST_CASE("what is no picture and no first cell is refused in a line") {
    const auto message = [](int width, const AdaptiveConfig& config) -> std::string {
        try {
            adaptive_picture(width, 4, config, [](int, int) { return PictureSample{}; });
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    CHECK(message(-1, {}) == "adaptive sampling: a picture of -1 x 4 pixels");
    for (const int edge : {0, -2, 3, 12, 1 << 21}) {
        CAPTURE(edge);
        CHECK(message(4, {.first_cell = edge}) ==
              "adaptive sampling: the first cell must be a power of two up to 1048576, not " +
                  std::to_string(edge));
    }
    CHECK(message(4, {.first_cell = 1 << 20}).empty());
}

TEST_CASE("each sample of the room is chapter 1's pixel, bit for bit") {
    const Scene scene = make_scene("room:2");
    const auto tree = KdTree<>::build(scene.mesh.triangles());
    const int width = sized(100, 33), height = sized(75, 25);
    const Image full = render<NoCounts>(scene, tree, {.width = width, .height = height}).image;
    const PixelGrid grid(scene.camera, width, height);
    const AdaptivePicture picture = adaptive_picture(width, height, {}, [&](int x, int y) {
        return sample_of_ray(scene, tree, grid.ray(x, y));
    });
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (is_traced(picture, x, y)) REQUIRE(picture.image.at(x, y) == full.at(x, y));
    CHECK(picture.rays < std::size_t(width) * std::size_t(height));
}

TEST_CASE("where a ray hits nothing the sample is the background, and no triangle's") {
    Scene scene = make_scene("room:2");
    scene.background = {0.1f, 0.2f, 0.3f};
    const auto tree = KdTree<>::build(scene.mesh.triangles());
    const Ray outwards{.origin = {1000, 0, 0}, .direction = {1, 0, 0}};
    CHECK(sample_of_ray(scene, tree, outwards) ==
          PictureSample{scene.background, PictureSample::background});
}
