/// @file
/// A picture made in passes of one sample a pixel: after each it is whole, a little less noisy than
/// before, and can be put aside and gone on with.
#pragma once

#include "chapters/ch11_sampling_and_caching/film.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/camera.hpp"
#include "common/geometry.hpp"
#include "common/parallel.hpp"
#include "common/program/progress.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace space {

// [add_pass]
/// One more sample for each pixel of the film: the radiance along a ray through a point of the
/// pixel. `row_estimator()` is asked for each row and gives what its pixels call, Double3
/// estimate(const Ray&, Sampler&); so a row may have memory of its own. A sample's numbers depend
/// on the sampler's seed, pixel and sample alone: the same bytes for any number of threads, and
/// whether the passes follow each other in one run or in many.
template <class RowEstimator>
void add_pass(Film& film, const Camera& camera, const Sampler& numbers, unsigned threads,
              const RowEstimator& row_estimator, Progress* progress = nullptr) {
    const PixelGrid grid(camera, film.width, film.height);
    parallel_for(static_cast<std::size_t>(film.height), threads, 1, [&](std::size_t row) {
        Sampler sampler = numbers;
        auto estimate = row_estimator();
        for (int x = 0, y = static_cast<int>(row); x < film.width; ++x) {
            sampler.start(film.pixel(x, y), film.samples);
            const Double2 in_pixel = sampler.next_pair();
            const Ray ray = grid.ray_through(x + in_pixel.x, y + in_pixel.y);
            film.sums[film.pixel(x, y)] += estimate(ray, sampler);
        }
        if (progress) progress->step();
    });
    ++film.samples;
}
// [add_pass]

/// The film's bytes as a file keeps them: all bits of all sums, `key`, a text that says what
/// picture this is, and a checksum.
std::string film_state(const Film& film, std::string_view key);

/// The film of a file that holds film_state(film, key), of this size and with a pass or more.
/// @throws Error (bad_input) where the file cannot be read, is damaged, or belongs to a picture
/// with another key; the line names what differs
Film load_film_state(const std::filesystem::path& file, std::string_view key, int width,
                     int height);

}  // namespace space
