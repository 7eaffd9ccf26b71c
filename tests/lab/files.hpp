/// @file
/// The lab's files from the user's side.
#pragma once

#include "chapters/ch12_comparison/rays.hpp"
#include "common/program/file.hpp"

#include <array>
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

inline std::vector<HitRecord> read_hits(const std::filesystem::path& file) {
    const std::string bytes = read_file(file);
    if (bytes.size() % sizeof(HitRecord) != 0)
        throw std::runtime_error("a hits file without whole records");
    std::vector<HitRecord> hits(bytes.size() / sizeof(HitRecord));
    std::memcpy(hits.data(), bytes.data(), bytes.size());
    return hits;
}

}  // namespace space
