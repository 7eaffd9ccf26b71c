/// @file
/// A line cut at its commas.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace space {

/// "a,b,c" -> "a", "b", "c"; empty parts stay. They are views of the text.
inline std::vector<std::string_view> comma_parts(std::string_view text) {
    std::vector<std::string_view> parts;
    for (std::size_t comma; (comma = text.find(',')) != text.npos; text.remove_prefix(comma + 1))
        parts.push_back(text.substr(0, comma));
    parts.push_back(text);
    return parts;
}

}  // namespace space
