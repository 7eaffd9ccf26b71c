// Apart from the rest of the writer: a page's live drawings hold no pixels, and need no PNG.
#include "common/program/image.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

namespace space {
namespace {

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? digits[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

}  // namespace

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
