/// @file
/// Embree's instances: meshes, each in many places, by its plain interface. One level, which is
/// what distributions compile it for (RTC_MAX_INSTANCE_LEVEL_COUNT); groups of groups are placed
/// one by one. Include where CMake has found the library.
#pragma once

#include "common/embree_tree.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace space {

/// A mesh in a place: the matrix row by row, in floats, as Embree takes it.
struct EmbreePlaced {
    std::uint32_t mesh;
    std::array<float, 12> matrix;

    EmbreePlaced(std::uint32_t of, const std::array<std::array<double, 4>, 3>& rows) : mesh(of) {
        for (std::size_t i = 0; i < 12; ++i) matrix[i] = static_cast<float>(rows[i / 4][i % 4]);
    }
};

/// A hit of instances: triangles are counted through all of them, in their order.
struct EmbreePlacedHit {
    float t, u, v;
    std::uint64_t triangle;
};

/// A device, a scene for each mesh, and one of the instances. Throws what Embree reports.
class EmbreeInstances {
  public:
    EmbreeInstances(std::span<const std::span<const Triangle>> meshes,
                    std::span<const EmbreePlaced> placed, unsigned threads,
                    const EmbreeFlavour& flavour = {})
        : device_(threads), top_(rtcNewScene(device_), rtcReleaseScene) {
        for (const std::span<const Triangle> mesh : meshes) {
            meshes_.push_back(std::make_unique<const EmbreeScene>(device_, mesh, flavour));
            references_ += mesh.size();
        }
        std::uint64_t triangles = 0;
        for (const auto& [mesh, matrix] : placed) {
            first_triangle_.push_back(triangles);
            triangles += meshes[mesh].size();
            const RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(instance, *meshes_[mesh]);
            rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, matrix.data());
            rtcCommitGeometry(instance);
            rtcAttachGeometry(top(), instance);  // numbered from 0 on, in this order
            rtcReleaseGeometry(instance);
        }
        rtcSetSceneBuildQuality(top(), flavour.quality);
        rtcSetSceneFlags(top(), flavour.flags);
        rtcCommitScene(top());
        device_.check();
    }

    template <class Counts>
    std::optional<EmbreePlacedHit> closest_hit(const Ray& ray, Counts&) const {
        if (!is_valid(ray)) return std::nullopt;
        const std::optional<RTCRayHit> hit = embree_detail::nearest(top(), ray);
        if (!hit) return std::nullopt;
        return EmbreePlacedHit{hit->ray.tfar, hit->hit.u, hit->hit.v,
                               first_triangle_[hit->hit.instID[0]] + hit->hit.primID};
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts&) const {
        return is_valid(ray) && embree_detail::is_occluded(top(), ray);
    }
    TreeShape shape() const {
        TreeShape shape{.bytes =
                            device_.bytes() + first_triangle_.capacity() * sizeof(std::uint64_t)};
        for (const auto& mesh : meshes_) shape.bytes += mesh->bytes();
        shape.references = references_;
        return shape;
    }

  private:
    RTCScene top() const { return top_.get(); }

    EmbreeDevice device_;
    std::vector<std::unique_ptr<const EmbreeScene>> meshes_;
    std::vector<std::uint64_t> first_triangle_;  ///< of each instance
    std::size_t references_ = 0;
    std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> top_;
};

}  // namespace space
