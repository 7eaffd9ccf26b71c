#include "common/program/image_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace space {
namespace {

/// What the face knows.
std::string ascii(std::string_view text) {
    std::string known(text);
    std::ranges::replace_if(
        known, [](char c) { return c < ' ' || c > '~'; }, '?');
    return known;
}

/// A corner as stb_easy_font writes it.
struct Corner {
    float x, y, z;
    std::array<unsigned char, 4> color;
};

}  // namespace

int text_width(std::string_view text, int scale) {
    return scale * stb_easy_font_width(ascii(text).data());
}

void fill_rectangle(Image& image, int x, int y, int width, int height, const glm::vec3& color) {
    const int right = std::min(x + width, image.width()),
              bottom = std::min(y + height, image.height());
    for (int row = std::max(y, 0); row < bottom; ++row)
        for (int column = std::max(x, 0); column < right; ++column) image.at(column, row) = color;
}

void draw_text(Image& image, int x, int y, std::string_view text, int scale,
               const glm::vec3& color) {
    constexpr std::size_t quads_a_letter = 16;  // more than any has
    std::string letters = ascii(text);
    std::vector<std::array<Corner, 4>> quads(quads_a_letter * letters.size());
    const int count =
        stb_easy_font_print(0.0f, 0.0f, letters.data(), nullptr, quads.data(),
                            static_cast<int>(quads.size() * sizeof(std::array<Corner, 4>)));
    for (const auto& [top_left, top_right, bottom_right, bottom_left] :
         std::span(quads).first(static_cast<std::size_t>(count)))
        fill_rectangle(image, x + scale * static_cast<int>(top_left.x),
                       y + scale * static_cast<int>(top_left.y),
                       scale * static_cast<int>(bottom_right.x - top_left.x),
                       scale * static_cast<int>(bottom_right.y - top_left.y), color);
}

}  // namespace space
