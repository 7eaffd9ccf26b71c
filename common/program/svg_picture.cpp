// Apart from the rest of the writer: a page's live drawings hold no pixels, and need no PNG.
#include "common/program/base64.hpp"
#include "common/program/image.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

namespace space {

void Svg::picture(Point2 corner, Vector2 size, const Image& image, std::string_view id) {
    const bool pixels_show = size.x >= 2.0f * static_cast<float>(image.width());
    element(
        "image",
        fmt::format("{} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" "
                    "href=\"data:image/png;base64,{}\"",
                    pixels_show ? " class=\"pixels\" image-rendering=\"optimizeSpeed\"" : "",
                    svg_number(corner.x), svg_number(corner.y), svg_number(size.x),
                    svg_number(size.y), base64(png_bytes(image))),
        id);
}

}  // namespace space
