// A small picture, sampled wave by wave: which cells there are, and which pixels are traced.

#include "chapters/ch06_quadtrees_and_octrees/adaptive_sampling.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace space::ch06 {
namespace {

constexpr int width = 32, height = 20;
constexpr float pixel_side = 19.5f, left = 8, waves_top = 8;

/// A ball, lit from the upper left, before a sky; and a wire, which comes out from behind it.
PictureSample sample_at(int x, int y) {
    const double u = (x - 10.0) / 6.2, v = (y - 9.5) / 6.2, square = u * u + v * v;
    if (square < 1.0) {
        const double light = std::max(0.0, (-0.55 * u - 0.6 * v + 0.58 * std::sqrt(1.0 - square)));
        return {Color(0.55f, 0.16f, 0.06f) * float(0.12 + 1.1 * light), 1};
    }
    if (x > 10 && y == 6 + (x - 10) / 4) return {Color(0.02f), 2};
    const float sky = float(y) / height;
    return {glm::mix(Color(0.36f, 0.55f, 0.80f), Color(0.75f, 0.82f, 0.86f), sky), 0};
}

struct Wave {
    std::vector<PixelCell> cells;
    std::vector<Pixel> traced;
};
struct Waves {
    std::vector<Wave> waves;
    void observe(const SamplingWave& wave) {
        waves.push_back(
            {{wave.cells.begin(), wave.cells.end()}, {wave.traced.begin(), wave.traced.end()}});
    }
};

Point2 place(int x, int y) {
    return {left + pixel_side * float(x), waves_top + pixel_side * float(y)};
}

/// Pixels' colours, at the paper's size; white where there is none yet.
void draw_picture(Svg& svg, const Image& image) {
    svg.picture(place(0, 0), {pixel_side * width, pixel_side * height}, image);
}

void draw_cell(Svg& svg, const PixelCell& cell, Ink ink) {
    const int x = std::min(cell.x + cell.edge, width), y = std::min(cell.y + cell.edge, height);
    svg.rect(place(cell.x, cell.y), place(x, y) - place(cell.x, cell.y), {.stroke = ink});
}

void draw_traced(Svg& svg, const Pixel& pixel, bool is_new) {
    svg.circle(place(pixel.x, pixel.y) + Vector2(0.5f * pixel_side), is_new ? 5.0 : 2.5,
               {.stroke = Ink::paper, .fill = is_new ? Ink::orange : Ink::ink});
}

std::string told(std::size_t wave, const Wave& now) {
    if (wave == 0)
        return fmt::format(
            "{} first cells of 8 × 8 pixels. Their corners, dots, are traced: {} rays.",
            now.cells.size(), now.traced.size());
    return fmt::format("Cells whose samples differ are split. {} new cells ask for {} more pixels.",
                       now.cells.size(), now.traced.size());
}

}  // namespace

Svg fig_06_12(const Options&) {
    Svg svg("A small picture by adaptive sampling, wave by wave: cells, and the pixels traced",
            2 * left + pixel_side * width, 2 * waves_top + pixel_side * height);
    Waves seen;
    const AdaptivePicture picture =
        adaptive_picture(width, height, {.threshold = 24, .first_cell = 8}, sample_at, seen);
    const std::size_t steps = seen.waves.size() + 2;
    Image full(width, height);
    std::size_t wrong = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            full.at(x, y) = sample_at(x, y).color;
            wrong += srgb_byte(full.at(x, y).r) != srgb_byte(picture.image.at(x, y).r);
        }

    svg.begin_step_alone(0, steps, "The picture that is to come, with a ray for each pixel.");
    draw_picture(svg, full);
    svg.end_group();
    for (std::size_t k = 0; k < seen.waves.size(); ++k) {
        svg.begin_step_alone(k + 1, steps, told(k, seen.waves[k]));
        Image known(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) known.at(x, y) = Color(0.82f);
        for (std::size_t i = 0; i <= k; ++i)
            for (const Pixel& p : seen.waves[i].traced) known.at(p.x, p.y) = full.at(p.x, p.y);
        draw_picture(svg, known);
        for (std::size_t i = 0; i <= k; ++i)
            for (const PixelCell& cell : seen.waves[i].cells)
                draw_cell(svg, cell, i == k ? Ink::orange : Ink::quiet);
        for (std::size_t i = 0; i <= k; ++i)
            for (const Pixel& p : seen.waves[i].traced) draw_traced(svg, p, i == k);
        svg.end_group();
    }
    svg.begin_step_alone(
        steps - 1, steps,
        fmt::format("No cell is uneven any more. {} of {} pixels are traced, dots; the others are "
                    "interpolated, and {} of them are not quite the full picture's.",
                    picture.rays, width * height, wrong));
    draw_picture(svg, picture.image);
    for (const PixelCell& cell : picture.cells)
        if (cell.edge > 1) draw_cell(svg, cell, Ink::quiet);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (picture.traced[std::size_t(y * width + x)]) draw_traced(svg, {x, y}, false);
    svg.end_group();
    return svg;
}

}  // namespace space::ch06
