#include "chapters/ch06_quadtrees_and_octrees/figures/sampling_panels.hpp"

#include "common/scenes/shapes.hpp"

#include <algorithm>
#include <cstdlib>

namespace space::ch06 {
namespace {

/// In greys that leave room for marks.
Color pale(const Color& color) {
    const float light = 0.2126f * color.r + 0.7152f * color.g + 0.0722f * color.b;
    return Color(0.45f + 0.45f * std::min(light, 1.0f));
}

/// Above it, and to its left.
template <class Visit>
void for_each_on_outline(const PixelCell& cell, const Image& image, const Visit& visit) {
    for (int x = cell.x; x < std::min(cell.x + cell.edge, image.width()); ++x) visit(x, cell.y);
    for (int y = cell.y; y < std::min(cell.y + cell.edge, image.height()); ++y) visit(cell.x, y);
}

}  // namespace

Image cells_of(const AdaptivePicture& picture) {
    Image image = picture.image;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) image.at(x, y) = pale(image.at(x, y));
    for (const PixelCell& cell : picture.cells) {
        const bool is_pixel = cell.edge == 1;
        const Color mark = is_pixel ? srgb(0xE69F00) : srgb(0x404A55);
        const float strength = is_pixel ? 0.85f : cell.edge == 2 ? 0.4f : 0.7f;
        for_each_on_outline(cell, image, [&](int x, int y) {
            image.at(x, y) = glm::mix(pale(picture.image.at(x, y)), mark, strength);
        });
    }
    return image;
}

Image errors_of(const Image& picture, const Image& full, int threshold) {
    Image image = full;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            int off = 0;
            for (int channel = 0; channel < 3; ++channel)
                off = std::max(off, std::abs(srgb_byte(picture.at(x, y)[channel]) -
                                             srgb_byte(full.at(x, y)[channel])));
            const Color base = pale(full.at(x, y));
            image.at(x, y) =
                off == 0 ? base
                : off > threshold
                    ? srgb(0xD55E00)
                    : glm::mix(base, srgb(0x0072B2), 0.25f + 0.75f * float(off) / float(threshold));
        }
    return image;
}

Image enlarged(const Image& image, int scale) {
    Image large(scale * image.width(), scale * image.height());
    for (int y = 0; y < large.height(); ++y)
        for (int x = 0; x < large.width(); ++x) large.at(x, y) = image.at(x / scale, y / scale);
    return large;
}

Image four(const Image& a, const Image& b, const Image& c, const Image& d) {
    constexpr int gap = 8;
    const Image rows[] = {side_by_side({a, b}, gap), side_by_side({c, d}, gap)};
    Image all(rows[0].width(), rows[0].height() + gap + rows[1].height());
    for (int y = 0; y < all.height(); ++y)
        for (int x = 0; x < all.width(); ++x) {
            const int below = y - rows[0].height() - gap;
            all.at(x, y) = y < rows[0].height() ? rows[0].at(x, y)
                           : below < 0          ? Color(1.0f)
                                                : rows[1].at(x, below);
        }
    return all;
}

}  // namespace space::ch06
