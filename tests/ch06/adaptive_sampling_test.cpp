#include "chapters/ch06_quadtrees_and_octrees/adaptive_sampling.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <vector>

using namespace space;

namespace {

using Evidence = AdaptiveConfig::Evidence;
constexpr Evidence both[] = {Evidence::corners, Evidence::all_samples};

const Color black(0.0f), white(1.0f);

/// A whole picture, of which samples are taken.
struct Picture {
    int width, height;
    std::vector<PictureSample> samples;

    Picture(int w, int h, const std::function<PictureSample(int x, int y)>& at)
        : width(w), height(h) {
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) samples.push_back(at(x, y));
    }
    const PictureSample& at(int x, int y) const {
        return samples[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    }
    AdaptivePicture sampled(const AdaptiveConfig& config) const {
        return adaptive_picture(width, height, config, [&](int x, int y) { return at(x, y); });
    }
};

bool is_traced(const AdaptivePicture& picture, int x, int y) {
    return picture.traced[std::size_t(y) * std::size_t(picture.image.width()) + std::size_t(x)];
}

/// Equal bits: a NaN is like itself.
bool same_bits(const Color& a, const Color& b) {
    for (int channel = 0; channel < 3; ++channel)
        if (std::bit_cast<std::uint32_t>(a[channel]) != std::bit_cast<std::uint32_t>(b[channel]))
            return false;
    return true;
}
std::size_t wrong_pixels(const Picture& full, const AdaptivePicture& picture) {
    std::size_t wrong = 0;
    for (int y = 0; y < full.height; ++y)
        for (int x = 0; x < full.width; ++x)
            wrong += !same_bits(full.at(x, y).color, picture.image.at(x, y));
    return wrong;
}

int steps_between(const Color& a, const Color& b) {
    int largest = 0;
    for (int channel = 0; channel < 3; ++channel)
        largest = std::max(largest, std::abs(srgb_byte(a[channel]) - srgb_byte(b[channel])));
    return largest;
}

/// White where x >= 4, in a picture of 8 x 8.
Picture half_white() {
    return {8, 8, [](int x, int) { return PictureSample{x >= 4 ? white : black, x >= 4}; }};
}

PictureSample random_sample(Pcg32& random) {
    PictureSample sample;
    for (int channel = 0; channel < 3; ++channel) sample.color[channel] = random.uniform();
    if (random.below(20) == 0) sample.color.g = std::nanf("");
    if (random.below(20) == 0) sample.color.b = infinity;
    sample.surface = random.below(2);
    return sample;
}

int random_size(Pcg32& random) {
    return 1 + int(random.below(40));
}

/// Patches of a few pixels and noise: something for every rule to be even and uneven about.
Picture random_picture(Pcg32& random) {
    const int width = random_size(random), height = random_size(random);
    const int patch = 1 << random.below(5);
    std::vector<PictureSample> palette;
    for (int i = 0; i < 1024; ++i) palette.push_back(random_sample(random));
    const std::uint32_t kinds = 1 + random.below(4);
    return {width, height, [&](int x, int y) {
                if (random.below(200) == 0) return palette[random.below(1024)];
                return palette[(std::uint32_t(x / patch) * 5 + std::uint32_t(y / patch)) % kinds];
            }};
}

AdaptiveConfig random_config(Pcg32& random) {
    AdaptiveConfig config;
    config.threshold = int(random.below(40));
    config.compare_surfaces = random.below(2) == 0;
    config.evidence = both[random.below(2)];
    config.first_cell = 1 << random.below(6);
    return config;
}

void require_cells_cover_once(const AdaptivePicture& picture) {
    std::vector<int> covered(picture.traced.size());
    const int width = picture.image.width(), height = picture.image.height();
    for (const PixelCell& cell : picture.cells)
        for (int y = cell.y; y < std::min(cell.y + cell.edge, height); ++y)
            for (int x = cell.x; x < std::min(cell.x + cell.edge, width); ++x)
                ++covered[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    REQUIRE(std::ranges::all_of(covered, [](int times) { return times == 1; }));
}

}  // namespace

TEST_CASE("a picture of one colour takes the corners of its first cells, and no more") {
    const auto rays = [](int width, int height) {
        const Picture full(width, height, [](int, int) { return PictureSample{white, 7}; });
        const AdaptivePicture picture = full.sampled({.first_cell = 16});
        CHECK(wrong_pixels(full, picture) == 0);
        CHECK(picture.waves == std::size_t(width > 0 && height > 0));
        return picture.rays;
    };
    CHECK(rays(16, 16) == 4);   // columns and rows 0 and 15
    CHECK(rays(17, 17) == 4);   // 0 and 16: of the second cell one column or row alone is left
    CHECK(rays(18, 17) == 6);   // columns 0, 16 and 17
    CHECK(rays(32, 32) == 9);   // 0, 16 and 31
    CHECK(rays(33, 48) == 12);  // columns 0, 16 and 32; rows 0, 16, 32 and 47
    CHECK(rays(1, 1) == 1);
    CHECK(rays(1, 40) == 4);  // rows 0, 16, 32 and 39
    CHECK(rays(40, 1) == 4);
    CHECK(rays(0, 0) == 0);
    CHECK(rays(0, 5) == 0);
}

TEST_CASE("worked by hand: a picture of 8 x 8, black on the left and white on the right") {
    // Columns 0, 4, 7 by rows 0, 4, 7; then cells of two pixels on the left, columns 0, 2, 4 by
    // rows 0, 2, 4, 6, 7; then single pixels from 2 to 3, columns 2, 3, 4 by all rows.
    const Picture full = half_white();
    for (const Evidence evidence : both) {
        const AdaptivePicture picture = full.sampled({.evidence = evidence, .first_cell = 8});
        CHECK(picture.waves == 4);
        CHECK(picture.rays == 5 + 0 + 8 + 8 + 8 + 3);
        CHECK(picture.cells.size() == 2 + 4 + 16);
        CHECK(wrong_pixels(full, picture) == 0);
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                CAPTURE(x, y);
                const bool in_column[] = {
                    y % 2 == 0 || y == 7, false, true, true, true, false, false,
                    y % 4 == 0 || y == 7};
                CHECK(is_traced(picture, x, y) == in_column[x]);
            }
    }
}

TEST_CASE("worked by hand: what is even is interpolated along both axes") {
    // Exact in floats: quarters and halves.
    const Picture full(5, 5, [](int x, int y) {
        return PictureSample{{0.25f * float(x), 0.25f * float(y), 0.0625f * float(x * y)}, 0};
    });
    const AdaptivePicture picture = full.sampled({.threshold = 255, .first_cell = 4});
    CHECK(picture.rays == 4);
    CHECK(picture.image.at(1, 2) == Color(0.25f, 0.5f, 0.125f));
    CHECK(picture.image.at(3, 3) == Color(0.75f, 0.75f, 0.5625f));
    CHECK(wrong_pixels(full, picture) == 0);
}

TEST_CASE("the threshold is the largest difference that is even, in each channel by itself") {
    for (int channel = 0; channel < 3; ++channel) {
        const Picture full(5, 5, [&](int x, int y) {
            Color color(0.2f);
            if (x == 4 && y == 4) color[channel] = 0.3f;
            return PictureSample{color, 0};
        });
        const int steps = srgb_byte(0.3f) - srgb_byte(0.2f);
        CHECK(full.sampled({.threshold = steps, .first_cell = 4}).rays == 4);
        CHECK(full.sampled({.threshold = steps - 1, .first_cell = 4}).rays > 4);
    }
}

TEST_CASE("two surfaces of one colour are told apart if the caller wants") {
    const Picture full(8, 8, [](int x, int) { return PictureSample{white, x >= 4}; });
    CHECK(full.sampled({.compare_surfaces = false, .first_cell = 8}).rays == 4);
    CHECK(full.sampled({.compare_surfaces = true, .first_cell = 8}).rays == 32);
}

TEST_CASE("a traced pixel is the full picture's, each is traced once, and each lies in one cell") {
    Pcg32 random(1);
    for (int round = 0; round < sized(2'000, 200); ++round) {
        const Picture full = random_picture(random);
        const AdaptiveConfig config = random_config(random);
        CAPTURE(round, full.width, full.height, config.first_cell, config.threshold);
        std::vector<int> times(full.samples.size());
        const AdaptivePicture picture =
            adaptive_picture(full.width, full.height, config, [&](int x, int y) {
                ++times[std::size_t(y) * std::size_t(full.width) + std::size_t(x)];
                return full.at(x, y);
            });
        std::size_t rays = 0;
        for (int y = 0; y < full.height; ++y)
            for (int x = 0; x < full.width; ++x) {
                const int asked = times[std::size_t(y) * std::size_t(full.width) + std::size_t(x)];
                REQUIRE(asked == int(is_traced(picture, x, y)));
                rays += std::size_t(asked);
                if (asked) REQUIRE(same_bits(picture.image.at(x, y), full.at(x, y).color));
            }
        REQUIRE(picture.rays == rays);
        require_cells_cover_once(picture);
    }
}

TEST_CASE("with first cells of one pixel the picture is the full one, bit for bit") {
    Pcg32 random(2);
    for (int round = 0; round < 200; ++round) {
        const Picture full = random_picture(random);
        AdaptiveConfig config = random_config(random);
        config.first_cell = 1;
        const AdaptivePicture picture = full.sampled(config);
        REQUIRE(picture.rays == full.samples.size());
        REQUIRE(wrong_pixels(full, picture) == 0);
    }
}

TEST_CASE("what is left to interpolate lies in cells that are even by the rule") {
    Pcg32 random(3);
    for (int round = 0; round < sized(1'000, 100); ++round) {
        const Picture full = random_picture(random);
        const AdaptiveConfig config = random_config(random);
        const AdaptivePicture picture = full.sampled(config);
        CAPTURE(round, full.width, full.height, config.first_cell);
        for (const PixelCell& cell : picture.cells) {
            const int right = std::min(cell.x + cell.edge, full.width - 1),
                      below = std::min(cell.y + cell.edge, full.height - 1);
            for (const int y : {cell.y, below})
                for (const int x : {cell.x, right}) REQUIRE(is_traced(picture, x, y));
            if (cell.edge == 1) continue;
            SampleRange range;
            for (int y = cell.y; y <= below; ++y)
                for (int x = cell.x; x <= right; ++x) {
                    const bool corner = (x == cell.x || x == right) && (y == cell.y || y == below);
                    if (!is_traced(picture, x, y)) continue;
                    if (!corner && config.evidence == Evidence::corners) continue;
                    const Color& c = full.at(x, y).color;
                    range.add(full.at(x, y), {srgb_byte(c.r), srgb_byte(c.g), srgb_byte(c.b)});
                }
            REQUIRE(range.is_even(config));
        }
    }
}

TEST_CASE("no cell is split without a reason: its parent was uneven by what is known at the end") {
    Pcg32 random(4);
    for (int round = 0; round < sized(500, 50); ++round) {
        const Picture full = random_picture(random);
        AdaptiveConfig config = random_config(random);
        config.evidence = Evidence::corners;
        for (const PixelCell& cell : full.sampled(config).cells) {
            if (cell.edge == config.first_cell) continue;
            const int edge = 2 * cell.edge, x = cell.x / edge * edge, y = cell.y / edge * edge;
            SampleRange range;
            for (const int row : {y, std::min(y + edge, full.height - 1)})
                for (const int column : {x, std::min(x + edge, full.width - 1)}) {
                    const Color& c = full.at(column, row).color;
                    range.add(full.at(column, row),
                              {srgb_byte(c.r), srgb_byte(c.g), srgb_byte(c.b)});
                }
            REQUIRE_FALSE(range.is_even(config));
        }
    }
}

TEST_CASE("colours that are not finite stay where they are: nothing is interpolated from them") {
    Pcg32 random(5);
    for (int round = 0; round < sized(500, 50); ++round) {
        const Picture full = random_picture(random);
        const AdaptivePicture picture = full.sampled(random_config(random));
        for (int y = 0; y < full.height; ++y)
            for (int x = 0; x < full.width; ++x)
                if (!is_traced(picture, x, y)) REQUIRE(is_finite<3>(picture.image.at(x, y)));
    }
}

TEST_CASE("the same picture, cells and waves on every run and for any number of threads") {
    Pcg32 random(6);
    for (int round = 0; round < sized(60, 20); ++round) {
        const Picture full = random_picture(random);
        AdaptiveConfig config = random_config(random);
        const AdaptivePicture first = full.sampled(config);
        for (const unsigned threads : {1u, 2u, 5u}) {
            config.threads = threads;
            std::atomic<std::size_t> asked = 0;
            const AdaptivePicture again =
                adaptive_picture(full.width, full.height, config, [&](int x, int y) {
                    ++asked;
                    return full.at(x, y);
                });
            REQUIRE(asked == first.rays);
            REQUIRE(wrong_pixels({full.width, full.height,
                                  [&](int x, int y) {
                                      return PictureSample{first.image.at(x, y), 0};
                                  }},
                                 again) == 0);
            REQUIRE(again.traced == first.traced);
            REQUIRE(again.cells == first.cells);
            REQUIRE(again.waves == first.waves);
        }
    }
}

TEST_CASE("an interpolated colour is never beyond its ends, however different they are") {
    Pcg32 random(7);
    const auto wild = [&] {
        const double sign = random.below(2) ? 1.0 : -1.0;
        const int exponent = int(random.below(200)) - 100;
        return sign * double(float(std::ldexp(1.0 + random.uniform(), exponent)));
    };
    for (int round = 0; round < sized(200'000, 20'000); ++round) {
        const double a = wild(), b = random.below(4) == 0 ? a : wild();
        const int steps = 1 + int(random.below(1 << (1 + random.below(16))));
        for (const int step : {0, 1, steps / 2, steps - 1, steps}) {
            const double value = between(Double3(a), Double3(b), step, steps).x;
            REQUIRE((std::min(a, b) <= value && value <= std::max(a, b)));
            if (step == 0) REQUIRE(value == a);
            if (step == steps) REQUIRE(value == b);
        }
    }
}

TEST_CASE(
    "where colours only rise or only fall along the axes no pixel is off by more than the "
    "threshold") {
    Pcg32 random(8);
    double largest_share = 0.0;
    for (int round = 0; round < sized(400, 100); ++round) {
        const int width = random_size(random), height = random_size(random);
        const auto rising = [&](int n) {
            std::vector<float> values{0.0f};
            for (int i = 1; i < n; ++i)
                values.push_back(values.back() +
                                 (random.below(3) ? 0.0f : 0.04f * random.uniform()));
            if (random.below(2)) std::ranges::reverse(values);
            return values;
        };
        const std::vector<float> across = rising(width), down = rising(height);
        const Picture full(width, height, [&](int x, int y) {
            return PictureSample{Color(across[std::size_t(x)] + down[std::size_t(y)]), 0};
        });
        const AdaptiveConfig config = random_config(random);
        const AdaptivePicture picture = full.sampled(config);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const int off = steps_between(picture.image.at(x, y), full.at(x, y).color);
                REQUIRE(off <= config.threshold);
                if (config.threshold > 0)
                    largest_share = std::max(largest_share, double(off) / config.threshold);
            }
    }
    CHECK(largest_share > 0.7);
}

TEST_CASE("a bilinear picture is off by three roundings at most") {
    // The picture's own rounding, the corners' and the result's: u = 2^-24 of the largest value
    // each, and nine in double.
    Pcg32 random(9);
    double largest_share = 0.0;
    for (int round = 0; round < sized(400, 60); ++round) {
        const int width = random_size(random), height = random_size(random);
        double weights[4];
        for (double& weight : weights) weight = random.uniform_double();
        const auto exact = [&](int x, int y) {
            return weights[0] + weights[1] * x + weights[2] * y + weights[3] * x * y;
        };
        const Picture full(width, height, [&](int x, int y) {
            return PictureSample{Color(float(exact(x, y))), 0};
        });
        const AdaptivePicture picture =
            full.sampled({.threshold = 255, .first_cell = 1 << random.below(6)});
        const double bound = exact(width - 1, height - 1) * (3.0 * 0x1p-24 + 16.0 * 0x1p-53);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double off =
                    std::abs(double{picture.image.at(x, y).r} - double{full.at(x, y).color.r});
                REQUIRE(off <= bound);
                largest_share = std::max(largest_share, off / bound);
            }
    }
    CHECK(largest_share > 0.5);
}

TEST_CASE("a smooth picture is off by an eighth of its curvature times the cell's edge squared") {
    // Interpolating between ends W apart: W^2 / 8 times the largest second derivative, along each
    // axis. A parabola has that error in the middle.
    constexpr double across = 3e-4, down = 2e-4;  // half of the second derivatives
    for (const int edge : {2, 4, 8, 16}) {
        const Picture full(65, 65, [&](int x, int y) {
            return PictureSample{Color(float(across * x * x + down * y * y)), 0};
        });
        const AdaptivePicture picture = full.sampled({.threshold = 255, .first_cell = edge});
        const double bound = 2.0 * (across + down) * edge * edge / 8.0;
        double largest = 0.0;
        for (int y = 0; y < 65; ++y)
            for (int x = 0; x < 65; ++x)
                largest = std::max(largest, std::abs(double{picture.image.at(x, y).r} -
                                                     double{full.at(x, y).color.r}));
        CAPTURE(edge);
        CHECK(largest <= bound + 4.0 * 0x1p-24 * 2.2);
        CHECK(largest >= 0.999 * bound);
    }
}
