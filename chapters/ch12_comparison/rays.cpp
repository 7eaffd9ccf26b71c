#include "chapters/ch12_comparison/rays.hpp"

#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "common/pcg32.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace space {
namespace {

// The files' records are the machine's own numbers.
static_assert(std::endian::native == std::endian::little);

/// Cosine-distributed about the unit normal (Malley's method: a point of the unit disc, lifted to
/// the hemisphere). The disc is sampled by rejection: no sine or cosine, whose last bits differ
/// between libraries.
Vector3 cosine_direction(const Double3& normal, Pcg32& random) {
    double x, y, squared_radius;
    do {
        x = 2.0 * random.uniform_double() - 1.0;
        y = 2.0 * random.uniform_double() - 1.0;
        squared_radius = x * x + y * y;
    } while (squared_radius > 1.0);
    const Double3 axis = std::abs(normal.x) < 0.5 ? Double3(1.0, 0.0, 0.0) : Double3(0.0, 1.0, 0.0);
    const Double3 tangent = glm::normalize(glm::cross(axis, normal));
    return Vector3(x * tangent + y * glm::cross(normal, tangent) +
                   std::sqrt(1.0 - squared_radius) * normal);
}

}  // namespace

std::vector<Ray> read_rays(const std::filesystem::path& file) {
    using Record = std::array<float, 8>;
    const std::string bytes = read_file(file);
    if (bytes.size() % sizeof(Record) != 0)
        throw input_error(
            fmt::format("{}: {} bytes are not a whole number of rays, which have {} bytes each",
                        file.string(), bytes.size(), sizeof(Record)));
    const std::size_t count = bytes.size() / sizeof(Record);
    if (count == 0) throw input_error(fmt::format("{}: holds no ray", file.string()));
    if (count > max_rays)
        throw input_error(
            fmt::format("{}: holds {} rays, more than {}", file.string(), count, max_rays));
    std::vector<Ray> rays;
    rays.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        Record r;
        std::memcpy(r.data(), bytes.data() + i * sizeof r, sizeof r);
        rays.push_back({.origin = {r[0], r[1], r[2]},
                        .direction = {r[4], r[5], r[6]},
                        .tmin = r[3],
                        .tmax = r[7]});
    }
    return rays;
}

template <class Number>
std::string hits_bytes(std::span<const HitRecord> hits) {
    std::string bytes;
    bytes.reserve(hits.size() * (3 * sizeof(float) + sizeof(Number)));
    for (const auto& [t, u, v, triangle] : hits) {
        const std::array place{t, u, v};
        // no_triangle and some_triangle keep their meaning: the two largest numbers.
        const auto number = static_cast<Number>(triangle);
        bytes.append(reinterpret_cast<const char*>(place.data()), sizeof place);
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    return bytes;
}
template std::string hits_bytes<std::uint32_t>(std::span<const HitRecord>);
template std::string hits_bytes<std::uint64_t>(std::span<const HitRecord>);

std::vector<Ray> diffuse_rays(const std::function<Triangle(std::uint64_t)>& triangle_at,
                              std::span<const Ray> rays, std::span<const HitRecord> hits,
                              std::size_t count, std::uint64_t seed) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].is_hit()) starts.push_back(i);
    if (starts.empty()) return {};
    std::vector<Ray> diffuse;
    diffuse.reserve(count);
    Pcg32 random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t start = starts[i * starts.size() / count];
        const auto& [t, u, v, number] = hits[start];
        const Triangle triangle = triangle_at(number);
        const Double3 n = normal_towards(triangle, rays[start]);
        const Double3 point = hit_point(triangle, {.t = t, .u = u, .v = v});
        diffuse.push_back({.origin = shadow_origin(triangle, point, n),
                           .direction = cosine_direction(n, random)});
    }
    return diffuse;
}

}  // namespace space
