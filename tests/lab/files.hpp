/// @file
/// The lab's files from the user's side.
#pragma once

#include "chapters/ch12_comparison/rays.hpp"
#include "common/program/file.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace space {

inline void write_rays(const std::filesystem::path& file, std::span<const Ray> rays) {
    std::string bytes;
    for (const Ray& ray : rays) {
        const auto& [o, d, tmin, tmax] = ray;
        const std::array<float, 8> record{o.x, o.y, o.z, tmin, d.x, d.y, d.z, tmax};
        bytes.append(reinterpret_cast<const char*>(record.data()), sizeof record);
    }
    write_file(file, bytes);
}

/// A hits file whose triangles are of the type Number.
template <class Number = std::uint32_t>
std::vector<HitRecord> read_hits(const std::filesystem::path& file) {
    constexpr std::size_t record = 3 * sizeof(float) + sizeof(Number);
    const std::string bytes = read_file(file);
    if (bytes.size() % record != 0) throw std::runtime_error("a hits file without whole records");
    std::vector<HitRecord> hits;
    for (std::size_t at = 0; at < bytes.size(); at += record) {
        std::array<float, 3> place;
        Number number;
        std::memcpy(place.data(), bytes.data() + at, sizeof place);
        std::memcpy(&number, bytes.data() + at + sizeof place, sizeof number);
        const auto from_top = static_cast<Number>(~number);  // 0: a miss, 1: a hit not told
        hits.push_back({place[0], place[1], place[2],
                        from_top <= 1 ? HitRecord::no_triangle - from_top : number});
    }
    return hits;
}

}  // namespace space
