// How a cache is filled, round by round: its records on the floor of the room with two blocks, from
// above.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace space::ch11 {
namespace {

constexpr double filling_scale = 248, filling_accuracy = 0.3;

/// Of the records that are new at each spacing of pixels: 16, 8, 4, 2, 1.
constexpr std::array round_inks{Ink::blue, Ink::vermillion, Ink::green, Ink::purple, Ink::quiet};

Point2 from_above(const Double3& p) {
    return at(86 + filling_scale * (p.x + 1.0), 10 + filling_scale * (p.z + 1.0));
}

struct RoundWatcher {
    std::vector<CacheRound> rounds = {};
    void observe(const CacheRound& round) { rounds.push_back(round); }
};

void draw_records(Svg& svg, const IrradianceCache& cache, std::size_t first, std::size_t last,
                  Ink ink) {
    for (std::size_t i = first; i < last; ++i) {
        const IrradianceRecord& record = cache.records()[i];
        if (record.position.y > 0.01 || record.normal.y < 0.9) continue;
        svg.circle(from_above(record.position), filling_scale * filling_accuracy * record.radius,
                   {.stroke = ink});
        svg.circle(from_above(record.position), 3, {.stroke = {}, .fill = ink});
    }
}

}  // namespace

Svg fig_11_19(const Options& options) {
    LitPicture box("box", 64, 80, options.threads);
    box.lit.scene.camera = {
        .eye = {0, 1.9f, 0.25f}, .target = {0, 0, 0.25f}, .up = {0, 0, -1}, .field_of_view = 68};
    RoundWatcher watcher;
    const IrradianceCache cache = fill_cache(
        box.tree, box.lit, box.lights, box.pixels(),
        RadianceCacheConfig{
            .accuracy = filling_accuracy, .grid = {.rings = 12, .sectors = 36}, .coarsest = 16},
        1, watcher);
    Svg svg("Records of a cache on a floor, round by round", 668, 640);
    svg.rect(from_above({-1, 0, -1}), at(filling_scale * 2, filling_scale * 2.5));
    for (std::size_t i = 12; i < box.lit.triangles.size(); ++i) {  // after the room's six sides
        const Triangle& t = box.lit.triangles[i];
        if (t.a.y < 1.5f && t.a.y > 0.01f && t.a.y == t.b.y && t.b.y == t.c.y)
            svg.polygon(
                {from_above(Double3(t.a)), from_above(Double3(t.b)), from_above(Double3(t.c))},
                {.stroke = {}, .fill = Ink::faint});
    }
    std::size_t before = 0;
    int step = 0;
    for (std::size_t i = 0; i < watcher.rounds.size(); i += 3, ++step) {
        const CacheRound& round = watcher.rounds[i];
        svg.begin_step(step, {},
                       fmt::format("Pixels {} apart: {} new records, {} in all.",
                                   i == 0 ? round.spacing : round.spacing / 2,
                                   round.records - before, round.records));
        draw_records(svg, cache, before, round.records, round_inks[static_cast<std::size_t>(step)]);
        svg.end_group();
        before = round.records;
    }
    return svg;
}

}  // namespace space::ch11
