/// @file
/// Which colours a drawing (common/program/svg.hpp) has on a light and on a dark page.
#pragma once

#include "common/program/svg.hpp"

#include <string>
#include <string_view>

namespace space {

/// The colour of a text in an ink, on a light or a dark page. Green, vermillion and purple are
/// darker than as lines; orange, sky, yellow and faint are too pale for any text and become ink.
std::string_view svg_text_color(Ink ink, bool dark = false);

/// What is under it.
std::string_view svg_paper(bool dark = false);

/// A figure's file with the colours of a light or a dark page in its elements and no style that
/// changes them: for slide programs, which don't know the reader's setting.
std::string svg_fixed(std::string document, bool dark);

}  // namespace space
