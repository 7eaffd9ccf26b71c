/// @file
/// A quadtree over the pixels of a picture (after Whitted 1980): cells are split where their
/// samples differ, and what lies in an even cell is interpolated, not traced.
#pragma once

#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "chapters/ch06_quadtrees_and_octrees/cell_evidence.hpp"
#include "common/accelerator.hpp"
#include "common/observer.hpp"
#include "common/parallel.hpp"
#include "common/program/image.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// A pixel of the picture, by its column and row.
struct Pixel {
    int x, y;

    bool operator==(const Pixel&) const = default;
};

/// A square of pixels: x <= column < x + edge, y <= row < y + edge, so that each pixel lies in one
/// cell of each size. It may reach beyond the picture.
struct PixelCell {
    int x, y, edge;

    PixelCell child(int k) const {
        const int half = edge / 2;
        return {x + (k & 1) * half, y + (k >> 1) * half, half};
    }
    /// The child that holds the pixel.
    int child_of(const Pixel& pixel) const {
        return int(pixel.x >= x + edge / 2) + 2 * int(pixel.y >= y + edge / 2);
    }
    bool operator==(const PixelCell&) const = default;
};

/// A picture, and where it was looked at.
struct AdaptivePicture {
    Image image;
    std::vector<bool> traced;      ///< row by row from the top left
    std::vector<PixelCell> cells;  ///< the leaves that have pixels of the picture
    std::size_t rays = 0;          ///< one for each traced pixel
    std::size_t waves = 0;         ///< how often cells were split
};

/// For an observer: the cells whose corners are looked at together, and which pixels are traced for
/// it.
struct SamplingWave {
    std::span<const PixelCell> cells;
    std::span<const Pixel> traced;
};

// [between]
/// From a, at 0, to b, at `steps`: the value at `step`. Never beyond a or b, whatever is rounded:
/// strictly between the ends the product is less than |b - a|, for (1 - 1/steps) (1 + 2^-53)^3 < 1;
/// so the exact sum lies between a and b, and rounding keeps the order.
inline Double3 between(const Double3& a, const Double3& b, int step, int steps) {
    if (step == 0) return a;
    if (step == steps) return b;
    return a + (b - a) * (double(step) / steps);
}
// [between]

/// Makes one picture; sample_of(x, y) traces a pixel's ray, on any of the threads.
template <class SampleOf, class Observer>
class AdaptiveSampler {
  public:
    AdaptiveSampler(int width, int height, const AdaptiveConfig& config, const SampleOf& sample_of,
                    Observer& observer)
        : width_(width),
          height_(height),
          config_(config),
          sample_of_(sample_of),
          observer_(observer),
          taken_(std::size_t(width) * std::size_t(height)) {}

    // [sample]
    /// Wave after wave: the new cells' corners are traced, cells with differing samples are split,
    /// and their children are the new cells. What comes out does not depend on the order: samples
    /// only come, and a cell that is uneven stays so.
    AdaptivePicture sample() {
        std::size_t waves = 0;
        for (std::vector<std::size_t> fresh = first_cells(); !fresh.empty(); ++waves) {
            const std::vector<Pixel> traced = trace_corners(fresh);
            tell(fresh, traced);
            fresh = split(uneven_cells(fresh, traced));
        }
        return finished(waves);
    }
    // [sample]

  private:
    struct Taken {
        PictureSample sample;
        std::array<std::uint8_t, 3> shown{};
        bool is_taken = false;
    };
    struct Node {
        PixelCell cell;
        SampleRange range = {};
        std::size_t first_child = 0;  ///< of four; 0: a leaf
    };

    std::size_t index(const Pixel& p) const {
        return std::size_t(p.y) * std::size_t(width_) + std::size_t(p.x);
    }
    const Taken& at(const Pixel& p) const { return taken_[index(p)]; }

    // [corners]
    /// A cell's last corner is the first pixel after it, its neighbour's corner: what is
    /// interpolated has no seams. At the right and lower border of the picture it is the last pixel
    /// that there is.
    Pixel last_corner(const PixelCell& cell) const {
        return {std::min(cell.x + cell.edge, width_ - 1),
                std::min(cell.y + cell.edge, height_ - 1)};
    }
    // [corners]
    bool is_in_picture(const PixelCell& cell) const { return cell.x < width_ && cell.y < height_; }
    std::array<Pixel, 4> corners(const PixelCell& cell) const {
        const Pixel last = last_corner(cell);
        return {Pixel{cell.x, cell.y}, {last.x, cell.y}, {cell.x, last.y}, last};
    }
    /// Calls visit(pixel) for all pixels of the cell and on its border.
    template <class Visit>
    void for_each_in_closed(const PixelCell& cell, const Visit& visit) const {
        const Pixel last = last_corner(cell);
        for (int y = cell.y; y <= last.y; ++y)
            for (int x = cell.x; x <= last.x; ++x) visit(Pixel{x, y});
    }

    std::vector<std::size_t> first_cells() {
        std::vector<std::size_t> cells;
        for (int y = 0; y < height_; y += config_.first_cell)
            for (int x = 0; x < width_; x += config_.first_cell) {
                cells.push_back(nodes_.size());
                nodes_.push_back({.cell = {x, y, config_.first_cell}});
            }
        return cells;
    }

    /// Each pixel is traced once, however many cells have a corner there.
    std::vector<Pixel> trace_corners(const std::vector<std::size_t>& fresh) {
        std::vector<Pixel> wanted;
        for (const std::size_t node : fresh)
            for (const Pixel& corner : corners(nodes_[node].cell))
                if (!std::exchange(taken_[index(corner)].is_taken, true)) wanted.push_back(corner);
        constexpr std::size_t chunk = 32;
        parallel_for(wanted.size(), config_.threads, chunk, [&](std::size_t i) {
            Taken& taken = taken_[index(wanted[i])];
            taken.sample = sample_of_(wanted[i].x, wanted[i].y);
            for (int channel = 0; channel < 3; ++channel)
                taken.shown[std::size_t(channel)] = srgb_byte(taken.sample.color[channel]);
        });
        return wanted;
    }

    // [uneven]
    /// The leaves that have to be split: of the new cells, and with `all_samples` of those that a
    /// new sample lies in, or on the border of, which are up to four.
    std::vector<std::size_t> uneven_cells(const std::vector<std::size_t>& fresh,
                                          const std::vector<Pixel>& traced) {
        std::vector<std::size_t> uneven;
        const auto judge = [&](std::size_t node) {
            if (nodes_[node].cell.edge > 1 && !nodes_[node].range.is_even(config_))
                uneven.push_back(node);
        };
        for (const std::size_t node : fresh) {
            nodes_[node].range = range_of(nodes_[node].cell);
            judge(node);
        }
        if (config_.evidence == AdaptiveConfig::Evidence::all_samples)
            for (const Pixel& p : traced)
                for (int y = std::max(p.y - 1, 0); y <= p.y; ++y)
                    for (int x = std::max(p.x - 1, 0); x <= p.x; ++x) {
                        const std::size_t leaf = leaf_of({x, y});
                        nodes_[leaf].range.add(at(p).sample, at(p).shown);
                        judge(leaf);
                    }
        std::ranges::sort(uneven);
        uneven.erase(std::unique(uneven.begin(), uneven.end()), uneven.end());
        return uneven;
    }
    // [uneven]

    SampleRange range_of(const PixelCell& cell) const {
        SampleRange range;
        const auto add = [&](const Pixel& p) {
            if (at(p).is_taken) range.add(at(p).sample, at(p).shown);
        };
        if (config_.evidence == AdaptiveConfig::Evidence::all_samples)
            for_each_in_closed(cell, add);
        else
            std::ranges::for_each(corners(cell), add);
        return range;
    }

    std::size_t leaf_of(const Pixel& p) const {
        const auto first = [&](int i) { return std::size_t(i / config_.first_cell); };
        std::size_t node = first(p.y) * (first(width_ - 1) + 1) + first(p.x);
        while (nodes_[node].first_child)
            node = nodes_[node].first_child + std::size_t(nodes_[node].cell.child_of(p));
        return node;
    }

    /// @return the children that have pixels of the picture
    std::vector<std::size_t> split(const std::vector<std::size_t>& uneven) {
        std::vector<std::size_t> children;
        for (const std::size_t parent : uneven) {
            nodes_[parent].first_child = nodes_.size();
            for (int k = 0; k < 4; ++k) {
                const PixelCell cell = nodes_[parent].cell.child(k);
                if (is_in_picture(cell)) children.push_back(nodes_.size());
                nodes_.push_back({.cell = cell});
            }
        }
        return children;
    }

    void tell(const std::vector<std::size_t>& fresh, const std::vector<Pixel>& traced) {
        std::vector<PixelCell> cells;
        if constexpr (!std::same_as<Observer, NoObserver>)
            for (const std::size_t node : fresh) cells.push_back(nodes_[node].cell);
        observer_.observe(SamplingWave{cells, traced});
    }

    // [fill]
    /// Traced pixels have their own colour, the others one between those of the corners: first down
    /// the two sides, then along the row.
    void fill(const PixelCell& cell, Image& image) const {
        const Pixel last = last_corner(cell);
        const auto color = [&](int x, int y) { return Double3(at({x, y}).sample.color); };
        for (int y = cell.y; y < std::min(cell.y + cell.edge, height_); ++y) {
            const int down = y - cell.y, rows = last.y - cell.y;
            const Double3 left = between(color(cell.x, cell.y), color(cell.x, last.y), down, rows);
            const Double3 right = between(color(last.x, cell.y), color(last.x, last.y), down, rows);
            for (int x = cell.x; x < std::min(cell.x + cell.edge, width_); ++x)
                image.at(x, y) = at({x, y}).is_taken
                                     ? at({x, y}).sample.color
                                     : Color(between(left, right, x - cell.x, last.x - cell.x));
        }
    }
    // [fill]

    AdaptivePicture finished(std::size_t waves) const {
        AdaptivePicture picture{.image = Image(width_, height_), .traced = {}, .cells = {}};
        for (const Taken& taken : taken_) picture.traced.push_back(taken.is_taken);
        picture.rays = std::size_t(std::ranges::count(picture.traced, true));
        picture.waves = waves;
        for (const Node& node : nodes_) {
            if (node.first_child || !is_in_picture(node.cell)) continue;
            picture.cells.push_back(node.cell);
            fill(node.cell, picture.image);
        }
        return picture;
    }

    int width_, height_;
    const AdaptiveConfig& config_;
    const SampleOf& sample_of_;
    Observer& observer_;
    std::vector<Taken> taken_;  ///< row by row from the top left
    std::vector<Node> nodes_;   ///< the first cells, row by row, and then what they are split into
};

/// The picture of width x height pixels whose samples sample_of(x, y) takes, as few as config says.
/// @throws std::invalid_argument for a size that is negative or a first cell that is no power of
/// two
template <class SampleOf, class Observer = NoObserver>
AdaptivePicture adaptive_picture(int width, int height, const AdaptiveConfig& config,
                                 const SampleOf& sample_of, Observer&& observer = {}) {
    if (width < 0 || height < 0)
        throw std::invalid_argument("adaptive sampling: a picture of " + std::to_string(width) +
                                    " x " + std::to_string(height) + " pixels");
    constexpr int largest = 1 << 20;
    if (config.first_cell < 1 || config.first_cell > largest ||
        !std::has_single_bit(unsigned(config.first_cell)))
        throw std::invalid_argument(
            "adaptive sampling: the first cell must be a power of two up "
            "to " +
            std::to_string(largest) + ", not " + std::to_string(config.first_cell));
    return AdaptiveSampler(width, height, config, sample_of, observer).sample();
}

/// What a ray sees of a scene: the colour that chapter 1 gives it, and the triangle as its surface.
template <Accelerator A>
PictureSample sample_of_ray(const Scene& scene, const A& accelerator, const Ray& ray) {
    const std::optional<Hit> hit = closest_hit(accelerator, ray);
    if (!hit) return {scene.background, PictureSample::background};
    const auto unoccluded = [&](const Ray& shadow) { return !any_hit(accelerator, shadow); };
    return {shade(scene, ray, *hit, unoccluded), hit->triangle};
}

}  // namespace space
