#include "chapters/ch12_comparison/lab_pictures.hpp"

#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "common/parallel.hpp"
#include "common/program/heat.hpp"
#include "common/program/image_text.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace space {
namespace {

constexpr Color paper{1.0f}, ink{0.0f};

/// A small picture's pixels become squares, so that it is about this wide or high.
constexpr int shown_size = 480;

/// 1, 2 or 5 times a power of ten: the first of these that is at least `number`.
std::uint64_t round_up(std::uint64_t number) {
    for (std::uint64_t power = 1;; power *= 10)
        for (const std::uint64_t digit : {1, 2, 5})
            if (digit * power >= number || power >= 1'000'000'000'000'000'000u)
                return digit * power;
}

std::uint64_t step_to(std::uint64_t end) {
    return round_up(end / 6 + (end % 6 != 0));
}

/// 1234 -> "1234", 20000 -> "20k", 1500000 -> "1.5M".
std::string short_number(std::uint64_t number) {
    const auto value = static_cast<double>(number);
    if (number < 10'000) return fmt::format("{}", number);
    if (number < 1'000'000) return fmt::format("{:g}k", value / 1e3);
    if (number < 1'000'000'000) return fmt::format("{:g}M", value / 1e6);
    return fmt::format("{:.4g}", value);
}

std::string summary(std::span<const std::uint64_t> values) {
    const auto sum = std::accumulate(
        values.begin(), values.end(), 0.0,
        [](double total, std::uint64_t value) { return total + static_cast<double>(value); });
    return fmt::format("{:.1f} on average, {} at most", sum / static_cast<double>(values.size()),
                       with_commas(std::ranges::max(values)));
}

/// The bar of colours and its numbers, between the columns `left` and `right` of the image.
void draw_scale(Image& image, int left, int right, int top, int size, const HeatScale& scale,
                bool more_beyond) {
    const int length = right - left, bar_height = 10 * size;
    for (int x = 0; x < length; ++x)
        fill_rectangle(image, left + x, top, 1, bar_height, heat((x + 0.5) / length));
    const auto number_at = [&](std::uint64_t value, const std::string& text) {
        const int x = left + static_cast<int>(static_cast<double>(value) /
                                              static_cast<double>(scale.end) * (length - 1));
        fill_rectangle(image, x, top + bar_height, size, 3 * size, ink);
        const int width = text_width(text, size);
        draw_text(image, std::min(x - width / 2, image.width() - width - size),
                  top + bar_height + 5 * size, text, size, ink);
    };
    for (std::uint64_t value = 0; scale.end - value >= scale.step; value += scale.step)
        number_at(value, short_number(value));
    number_at(scale.end, (more_beyond ? ">= " : "") + short_number(scale.end));
}

Color seen(const BuiltStructure& built, const Ray& ray, const HitRecord& hit, const Scene& scene,
           const Surfaces& surfaces) {
    const Triangle triangle = surfaces.triangle(hit.triangle);
    const Double3 n = normal_towards(triangle, ray);
    const Point3 origin =
        shadow_origin(triangle, hit_point(triangle, {.t = hit.t, .u = hit.u, .v = hit.v}), n);
    Color sum{0.0f};
    for (const PointLight& light : scene.lights) {
        const Ray shadow = shadow_ray(origin, light);
        const Double3 to_light{shadow.direction};
        if (!(glm::dot(n, to_light) > 0.0)) continue;
        HitRecord occluder;
        built.trace({{&shadow, 1}, {&occluder, 1}, Query::any});
        if (!occluder.is_hit())
            sum += lambert(surfaces.color(hit.triangle), light.intensity, n, to_light);
    }
    return sum;
}

}  // namespace

std::vector<TraversalCounts> counts_by_ray(const BuiltStructure& built, const Batch& batch) {
    std::vector<TraversalCounts> counts(batch.rays.size());
    parallel_for(batch.rays.size(), batch.threads, 128, [&](std::size_t i) {
        counts[i] = built.count({batch.rays.subspan(i, 1), batch.hits.subspan(i, 1), batch.query});
        if (batch.progress) batch.progress->step();
    });
    return counts;
}

std::vector<std::uint64_t> heat_values(std::span<const TraversalCounts> counts, HeatOf of) {
    std::vector<std::uint64_t> values;
    values.reserve(counts.size());
    for (const TraversalCounts& ray : counts)
        values.push_back(of == HeatOf::nodes ? ray.nodes_visited : ray.triangles_tested);
    return values;
}

HeatScale heat_scale_to(std::uint64_t end) {
    return {end, step_to(end)};
}

HeatScale heat_scale_of(std::span<const std::uint64_t> values) {
    std::vector<std::uint64_t> sorted(values.begin(), values.end());
    const auto place = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
    std::ranges::nth_element(sorted, place);
    const std::uint64_t most = std::max<std::uint64_t>(*place, 1), step = step_to(most);
    return {(most + step - 1) / step * step, step};
}

Image heat_map(std::span<const std::uint64_t> values, int width, int height, const HeatScale& scale,
               const std::string& title, HeatOf of) {
    const int enlarged = std::max(1, shown_size / std::max(width, height));
    const int map_width = enlarged * width, map_height = enlarged * height;
    const int full_width = std::max(map_width, shown_size), size = full_width / 240;
    const int margin = 16 * size;
    Image image(full_width, map_height + 76 * size);
    fill_rectangle(image, 0, 0, image.width(), image.height(), paper);
    const int left = (full_width - map_width) / 2;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto value = static_cast<double>(
                values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(x)]);
            fill_rectangle(image, left + enlarged * x, enlarged * y, enlarged, enlarged,
                           heat(value / static_cast<double>(scale.end)));
        }
    int y = map_height + 6 * size;
    for (const std::string& line :
         {title, std::string(heat_name(of)) + " a ray", summary(values)}) {
        const int fits = text_width(line, size) <= full_width - 2 * margin ? size : (size + 1) / 2;
        draw_text(image, margin, y, line, fits, ink);
        y += text_line * size;
    }
    draw_scale(image, margin, full_width - margin, y + 2 * size, size, scale,
               std::ranges::max(values) > scale.end);
    return image;
}

Image shaded_picture(const BuiltStructure& built, const PixelGrid& pixels, const Scene& scene,
                     const Surfaces& surfaces, unsigned threads) {
    Image image(pixels.width, pixels.height);
    Progress progress("picture", static_cast<std::size_t>(pixels.height));
    parallel_for(static_cast<std::size_t>(pixels.height), threads, 1, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < pixels.width; ++x) {
            const Ray ray = pixels.ray(x, y);
            HitRecord hit;
            built.trace({{&ray, 1}, {&hit, 1}, Query::closest});
            image.at(x, y) =
                hit.is_hit() ? seen(built, ray, hit, scene, surfaces) : scene.background;
        }
        progress.step();
    });
    return image;
}

}  // namespace space
