/// @file
/// A scene, the tree of its triangles and the rays of its picture: what figures and measurements
/// sample.
#pragma once

#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/adaptive_sampling.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace space::ch06 {

/// For each face the number of its object: faces that share a vertex are of one.
std::vector<std::uint32_t> objects_of(const TriangleMesh& mesh);

/// Pictures of one scene by its camera.
class SampledScene {
  public:
    SampledScene(Scene scene, int width, int height)
        : scene_(std::move(scene)),
          tree_(KdTree<>::build(scene_.mesh.triangles())),
          objects_(objects_of(scene_.mesh)),
          grid_(scene_.camera, width, height) {}

    const std::string& name() const { return scene_.name; }
    /// Whose surface is a triangle.
    PictureSample triangle_at(int x, int y) const {
        return sample_of_ray(scene_, tree_, grid_.ray(x, y));
    }
    /// Whose surface is an object.
    PictureSample object_at(int x, int y) const {
        PictureSample sample = triangle_at(x, y);
        if (sample.surface != PictureSample::background) sample.surface = objects_[sample.surface];
        return sample;
    }
    AdaptivePicture by_triangles(const AdaptiveConfig& config) const {
        return adaptive_picture(grid_.width, grid_.height, config,
                                [&](int x, int y) { return triangle_at(x, y); });
    }
    AdaptivePicture by_objects(const AdaptiveConfig& config) const {
        return adaptive_picture(grid_.width, grid_.height, config,
                                [&](int x, int y) { return object_at(x, y); });
    }
    /// One ray for each pixel.
    Image full() const {
        Image image(grid_.width, grid_.height);
        grid_.for_each([&](int x, int y) { image.at(x, y) = triangle_at(x, y).color; });
        return image;
    }

  private:
    Scene scene_;
    KdTree<> tree_;
    std::vector<std::uint32_t> objects_;
    PixelGrid grid_;
};

}  // namespace space::ch06
