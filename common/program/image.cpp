#include "common/program/image.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace space {

std::uint8_t srgb_byte(float linear) {
    if (!(linear > 0.0f)) return 0;
    const double x = std::min(linear, 1.0f);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

std::vector<std::uint8_t> srgb_bytes(const Image& image) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(std::size_t(image.width()) * std::size_t(image.height()) * 3);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int channel = 0; channel < 3; ++channel)
                bytes.push_back(srgb_byte(image.at(x, y)[channel]));
    return bytes;
}

std::uint64_t other_pixels(const Image& image, const Image& other) {
    std::uint64_t others = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) others += image.at(x, y) != other.at(x, y);
    return others;
}

Image side_by_side(const std::vector<Image>& images, int gap) {
    int width = -gap, height = 0;
    for (const Image& image : images) {
        width += image.width() + gap;
        height = std::max(height, image.height());
    }
    Image row(std::max(width, 0), height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < row.width(); ++x) row.at(x, y) = glm::vec3(1.0f);
    int left = 0;
    for (const Image& image : images) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) row.at(left + x, y) = image.at(x, y);
        left += image.width() + gap;
    }
    return row;
}

namespace {

void append_to(void* text, void* data, int size) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(data),
                                            static_cast<std::size_t>(size));
}

Error cannot_encode(const char* format, const Image& image) {
    return output_error(std::string("cannot encode a ") + format + " picture of " +
                        std::to_string(image.width()) + " x " + std::to_string(image.height()) +
                        " pixels");
}

}  // namespace

std::string png_bytes(const Image& image) {
    const std::vector<std::uint8_t> pixels = srgb_bytes(image);
    std::string png;
    if (!stbi_write_png_to_func(append_to, &png, image.width(), image.height(), 3, pixels.data(),
                                3 * image.width()))
        throw cannot_encode("PNG", image);
    return png;
}

void write_png(const std::filesystem::path& file, const Image& image) {
    write_file(file, png_bytes(image));
}

std::string hdr_bytes(const Image& image) {
    std::vector<float> values;
    values.reserve(std::size_t(image.width()) * std::size_t(image.height()) * 3);
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            for (int channel = 0; channel < 3; ++channel) {
                const float value = image.at(x, y)[channel];
                values.push_back(value > 0.0f ? std::min(value, 1e38f) : 0.0f);
            }
    std::string hdr;
    if (!stbi_write_hdr_to_func(append_to, &hdr, image.width(), image.height(), 3, values.data()))
        throw cannot_encode("Radiance", image);
    return hdr;
}

void write_hdr(const std::filesystem::path& file, const Image& image) {
    write_file(file, hdr_bytes(image));
}

}  // namespace space
