/// @file
/// One scene, drawn with one structure after the other: the pictures must be the same.
#pragma once

#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/program/chapter.hpp"
#include "common/program/image.hpp"
#include "common/program/options.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// A picture, and how many of its pixels are not as in the first one of its scene.
struct ComparedPicture {
    Rendering drawn;
    std::uint64_t other_pixels = 0;

    std::uint64_t rays() const { return drawn.counts.camera_rays + drawn.counts.shadow_rays; }
    double nodes_per_ray() const {
        return double(drawn.counts.traversal.nodes_visited) / double(rays());
    }
    double tests_per_ray() const {
        return double(drawn.counts.traversal.triangles_tested) / double(rays());
    }
};

/// The scene that a program is asked for, and the first picture of it.
class SamePicture {
  public:
    explicit SamePicture(const Options& options)
        : scene_(asked_scene(options)),
          triangles_(scene_.mesh.triangles()),
          settings_{.width = options.width, .height = options.height, .threads = options.threads} {}

    const Scene& scene() const { return scene_; }
    std::span<const Triangle> triangles() const { return triangles_; }

    /// By a structure over triangles(), whose name stands beside the progress.
    template <Accelerator A>
    ComparedPicture draw(const std::string& method, const A& structure) {
        Progress progress(method, static_cast<std::size_t>(settings_.height));
        ComparedPicture picture{render(scene_, structure, settings_, &progress)};
        if (!first_) first_ = picture.drawn.image;
        picture.other_pixels = other_pixels(picture.drawn.image, *first_);
        return picture;
    }

    void print_heading(const Options& options) const {
        space::print_heading(fmt::format("{}: {} triangles, {} x {} pixels", options.scene,
                                         with_commas(triangles_.size()), settings_.width,
                                         settings_.height));
    }

  private:
    Scene scene_;
    std::vector<Triangle> triangles_;
    RenderSettings settings_;
    std::optional<Image> first_;
};

}  // namespace space
