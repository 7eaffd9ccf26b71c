/// @file
/// Text in SVG files and in web pages.
#pragma once

#include <string>
#include <string_view>

namespace space {

/// Text as it may stand in an element or in an attribute; control characters that XML forbids
/// become U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace space
