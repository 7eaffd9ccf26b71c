/// @file
/// A bar of the chapter's drawings.
#pragma once

#include "common/program/svg.hpp"

namespace space::ch02 {

inline void bar(Svg& svg, double left, double right, double y, double height, Ink ink,
                double opacity = 1.0) {
    svg.rect(at(left, y), at(right - left, height),
             {.stroke = {}, .fill = ink, .opacity = opacity});
}

}  // namespace space::ch02
