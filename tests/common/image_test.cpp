#include "common/program/image.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace space {
namespace {

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = {float(x) / float(width), float(y) / float(height),
                              float(x ^ y) / 64.0f};
    return image;
}

}  // namespace

TEST_CASE("linear values become sRGB bytes as IEC 61966-2-1 says") {
    CHECK(srgb_byte(0.0f) == 0);
    CHECK(srgb_byte(1.0f) == 255);
    CHECK(srgb_byte(0.5f) == 188);        // 255 * 0.73536
    CHECK(srgb_byte(0.18f) == 118);       // 255 * 0.46136
    CHECK(srgb_byte(0.2140411f) == 127);  // 255 * 0.49999...
    CHECK(srgb_byte(0.001f) == 3);        // 255 * 12.92 * 0.001
    CHECK(srgb_byte(0.0031308f) == 10);
}

TEST_CASE("values that no colour has become black or full") {
    constexpr float inf = std::numeric_limits<float>::infinity();
    CHECK(srgb_byte(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(srgb_byte(-1.0f) == 0);
    CHECK(srgb_byte(-inf) == 0);
    CHECK(srgb_byte(-0.0f) == 0);
    CHECK(srgb_byte(2.0f) == 255);
    CHECK(srgb_byte(inf) == 255);
}

TEST_CASE("sRGB bytes grow with the value, and all 256 occur") {
    std::uint8_t before = 0;
    int steps = 1;
    for (int i = 0; i <= 100'000; ++i) {
        const std::uint8_t byte = srgb_byte(static_cast<float>(i) * 1e-5f);
        if (byte < before || byte > before + 1) FAIL("from " << int(before) << " to " << int(byte));
        steps += byte != before;
        before = byte;
    }
    CHECK(steps == 256);
}

TEST_CASE("a PNG file holds the picture's bytes, row by row from the top left") {
    const TemporaryDirectory directory;
    for (const auto& [width, height] : {std::pair{1, 1}, {17, 5}, {64, 48}}) {
        const Image image = gradient(width, height);
        const auto file = directory.path() / "picture.png";
        write_png(file, image);
        const std::string png = read_file(file);
        CHECK(png.starts_with("\x89PNG\r\n\x1a\n"));
        int w = 0, h = 0, channels = 0;
        stbi_uc* const pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(png.data()),
                                                      int(png.size()), &w, &h, &channels, 0);
        REQUIRE(pixels != nullptr);
        CHECK(w == width);
        CHECK(h == height);
        CHECK(channels == 3);
        CHECK(std::vector<std::uint8_t>(pixels, pixels + 3 * w * h) == srgb_bytes(image));
        stbi_image_free(pixels);
    }
    const Image two(2, 1);
    CHECK(srgb_bytes(two) == std::vector<std::uint8_t>(6, 0));
}

TEST_CASE("the same picture has the same PNG bytes") {
    CHECK(png_bytes(gradient(40, 30)) == png_bytes(gradient(40, 30)));
}

TEST_CASE("pictures side by side keep their pixels, with white between them") {
    Image left(2, 2), right(1, 2);
    left.at(1, 1) = {0.25f, 0, 0};
    right.at(0, 0) = {0, 0.5f, 0};
    const Image both = side_by_side({left, right}, 3);
    CHECK(both.width() == 2 + 3 + 1);
    CHECK(both.height() == 2);
    CHECK(both.at(1, 1) == glm::vec3(0.25f, 0, 0));
    CHECK(both.at(5, 0) == glm::vec3(0, 0.5f, 0));
    for (int x = 2; x < 5; ++x) CHECK(both.at(x, 1) == glm::vec3(1.0f));
    CHECK(side_by_side({left}) == left);
}

TEST_CASE("a picture that cannot be written is one clear error") {
    CHECK_THROWS_AS(write_png("/proc/none/picture.png", Image(2, 2)), Error);
    CHECK_THROWS_AS(write_png("/dev/full", Image(2, 2)), Error);
}

TEST_CASE("a Radiance file keeps light of any brightness to a part in 128 of its largest channel") {
    Image image(70, 3);  // as wide as what is run-length encoded
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 70; ++x) {
            const float scale = std::ldexp(1.0f, 2 * (x - 35));
            image.at(x, y) = scale * glm::vec3(1.0f, 0.3f * float(y), float(x) / 70.0f);
        }
    const std::string bytes = hdr_bytes(image);
    CHECK(bytes.starts_with("#?RADIANCE\n"));
    int width = 0, height = 0, channels = 0;
    float* const read = stbi_loadf_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                               int(bytes.size()), &width, &height, &channels, 3);
    REQUIRE(read);
    REQUIRE(width == 70);
    REQUIRE(height == 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 70; ++x) {
            const glm::vec3& kept = image.at(x, y);
            const float largest = std::max({kept.x, kept.y, kept.z});
            for (int channel = 0; channel < 3; ++channel) {
                CAPTURE(x, y, channel);
                CHECK(std::abs(read[(y * 70 + x) * 3 + channel] - kept[channel]) <=
                      largest / 128.0f);
            }
        }
    stbi_image_free(read);
}

TEST_CASE("a Radiance file has no NaN, nothing negative and nothing infinite") {
    Image image(1, 1);
    const auto bytes = [&](const glm::vec3& color) {
        image.at(0, 0) = color;
        return hdr_bytes(image);
    };
    constexpr float inf = std::numeric_limits<float>::infinity();
    CHECK(bytes({std::numeric_limits<float>::quiet_NaN(), -1.0f, -inf}) == bytes({0, 0, 0}));
    CHECK(bytes({inf, 3e38f, 1e38f}) == bytes({1e38f, 1e38f, 1e38f}));
}

}  // namespace space
