/// @file
/// Pictures: linear colours in memory, sRGB bytes in PNG files, or all light in Radiance's.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace space {

/// A picture in linear colours, row after row from the top.
class Image {
  public:
    Image(int width, int height)
        : width_(width), height_(height), pixels_(std::size_t(width) * std::size_t(height)) {}

    int width() const { return width_; }
    int height() const { return height_; }
    glm::vec3& at(int x, int y) {
        return pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
    }
    const glm::vec3& at(int x, int y) const {
        return pixels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
    }
    bool operator==(const Image&) const = default;

  private:
    int width_, height_;
    std::vector<glm::vec3> pixels_;  ///< linear RGB, row by row from the top left
};

/// A linear value in [0, 1] as an sRGB byte (IEC 61966-2-1); NaN gives 0.
std::uint8_t srgb_byte(float linear);

/// The pixels' sRGB bytes, row by row: what a PNG file holds.
std::vector<std::uint8_t> srgb_bytes(const Image& image);

/// How many pixels of two pictures of one size are not the same.
std::uint64_t other_pixels(const Image& image, const Image& other);

/// Several pictures of the same height in a row, `gap` white pixels between them.
Image side_by_side(const std::vector<Image>& images, int gap = 8);

/// The picture as the bytes of a PNG file.
std::string png_bytes(const Image& image);

/// @throws Error (bad_output)
void write_png(const std::filesystem::path& file, const Image& image);

/// The picture as the bytes of a Radiance file (.hdr): linear, of any brightness; three mantissas
/// of 8 bits share an exponent (Ward 1991, "Real Pixels"). NaN and what is below 0 become 0, what
/// is beyond 1e38 becomes 1e38.
std::string hdr_bytes(const Image& image);

/// @throws Error (bad_output)
void write_hdr(const std::filesystem::path& file, const Image& image);

}  // namespace space
