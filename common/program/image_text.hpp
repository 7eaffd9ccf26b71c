/// @file
/// Words and numbers in a picture of pixels, for legends.
#pragma once

#include "common/program/image.hpp"

#include <string_view>

namespace space {

/// From one line of text to the next, in pixels, at scale 1.
inline constexpr int text_line = 12;

/// In pixels; each pixel of the face is scale x scale of the picture's.
int text_width(std::string_view text, int scale);

/// Draws the text from its top left corner (x, y) in stb_easy_font's face, which knows ASCII alone:
/// for each other byte there is a question mark. What lies outside of the picture is left out.
void draw_text(Image& image, int x, int y, std::string_view text, int scale,
               const glm::vec3& color);

/// Fills width x height pixels from the top left corner (x, y), as far as they lie in the picture.
void fill_rectangle(Image& image, int x, int y, int width, int height, const glm::vec3& color);

}  // namespace space
