/// @file
/// Intel's Embree, 3 or 4, by its plain interface, one ray at a time, as any program would use it:
/// what structures are measured beside. Include where CMake has found the library.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "common/accelerator.hpp"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace space {

/// How Embree builds.
struct EmbreeFlavour {
    RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
    RTCSceneFlags flags = RTC_SCENE_FLAG_NONE;
    const char* names = "RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE";
};

namespace embree_detail {
#if RTC_VERSION_MAJOR >= 4
inline void intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray);
}
inline void occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray);
}
#else
inline void intersect(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
}
inline void occluded(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
#endif

inline RTCRay rtc_ray(const Ray& ray) {
    RTCRay result{};
    result.org_x = ray.origin.x;
    result.org_y = ray.origin.y;
    result.org_z = ray.origin.z;
    result.tnear = std::max(ray.tmin, 0.0f);
    result.dir_x = ray.direction.x;
    result.dir_y = ray.direction.y;
    result.dir_z = ray.direction.z;
    result.tfar = ray.tmax;
    result.mask = 0xFFFFFFFF;
    return result;
}

}  // namespace embree_detail

/// A device that keeps its first error and counts the memory that it takes.
class EmbreeDevice {
  public:
    explicit EmbreeDevice(unsigned threads)
        : device_(rtcNewDevice(fmt::format("threads={},set_affinity=0", threads).c_str())) {
        if (!device_) throw std::runtime_error("no Embree device");
        rtcSetDeviceErrorFunction(
            device_,
            [](void* first, RTCError, const char* text) {
                auto& message = *static_cast<std::string*>(first);
                if (message.empty()) message = text ? text : "unknown error";
            },
            &error_);
        rtcSetDeviceMemoryMonitorFunction(
            device_,
            [](void* bytes, ssize_t change, bool) {
                *static_cast<std::atomic<ssize_t>*>(bytes) += change;
                return true;
            },
            &bytes_);
    }
    ~EmbreeDevice() { rtcReleaseDevice(device_); }
    EmbreeDevice(const EmbreeDevice&) = delete;
    EmbreeDevice& operator=(const EmbreeDevice&) = delete;

    operator RTCDevice() const { return device_; }
    std::size_t bytes() const { return static_cast<std::size_t>(bytes_); }
    /// @throws what Embree has reported
    void check() const {
        if (!error_.empty()) throw std::runtime_error("Embree: " + error_);
    }

  private:
    std::string error_;
    std::atomic<ssize_t> bytes_{0};
    RTCDevice device_;
};

/// A scene of one mesh, and the corners that it shares with us.
class EmbreeScene {
  public:
    EmbreeScene(const EmbreeDevice& device, std::span<const Triangle> triangles,
                const EmbreeFlavour& flavour)
        : scene_(rtcNewScene(device)) {
        rtcSetSceneBuildQuality(scene_, flavour.quality);
        rtcSetSceneFlags(scene_, flavour.flags);
        attach(device, triangles);
        rtcCommitScene(scene_);
    }
    ~EmbreeScene() { rtcReleaseScene(scene_); }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    operator RTCScene() const { return scene_; }
    /// Of the corners alone: the rest is the device's.
    std::size_t bytes() const { return corners_.capacity() * sizeof(float); }

  private:
    void attach(const EmbreeDevice& device, std::span<const Triangle> triangles) {
        const std::size_t count = triangles.size();
        const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        static_assert(sizeof(Triangle) == 9 * sizeof(float));
        corners_.resize(9 * count + 1);  // Embree reads 16 bytes at the last corner
        if (count > 0) std::memcpy(corners_.data(), triangles.data(), triangles.size_bytes());
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   corners_.data(), 0, 3 * sizeof(float), 3 * count);
        if (auto* const indices = static_cast<std::uint32_t*>(
                rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        3 * sizeof(std::uint32_t), count)))
            for (std::uint32_t i = 0; i < 3 * count; ++i) indices[i] = i;
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
    }

    std::vector<float> corners_;
    RTCScene scene_;
};

namespace embree_detail {

/// The nearest hit of a valid ray.
inline std::optional<RTCRayHit> nearest(RTCScene scene, const Ray& ray) {
    RTCRayHit query{rtc_ray(ray), {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return query;
}
inline bool is_occluded(RTCScene scene, const Ray& ray) {
    RTCRay query = rtc_ray(ray);
    occluded(scene, query);
    return query.tfar == -infinity;
}

}  // namespace embree_detail

/// An accelerator: a device and a scene of one mesh. Throws what Embree reports.
class EmbreeTree {
  public:
    EmbreeTree(std::span<const Triangle> triangles, unsigned threads, const EmbreeFlavour& flavour)
        : count_(triangles.size()), device_(threads), scene_(device_, triangles, flavour) {
        device_.check();
    }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts&) const {
        if (!is_valid(ray)) return std::nullopt;
        const std::optional<RTCRayHit> hit = embree_detail::nearest(scene_, ray);
        if (!hit) return std::nullopt;
        return Hit{
            .t = hit->ray.tfar, .triangle = hit->hit.primID, .u = hit->hit.u, .v = hit->hit.v};
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts&) const {
        return is_valid(ray) && embree_detail::is_occluded(scene_, ray);
    }
    TreeShape shape() const {
        return {.references = count_, .bytes = device_.bytes() + scene_.bytes()};
    }

  private:
    std::size_t count_;
    EmbreeDevice device_;
    EmbreeScene scene_;
};

/// Denormals are zero, as Embree's manual asks for; threads that start meanwhile inherit it.
class DenormalsAreZero {
#ifdef __SSE__
  public:
    DenormalsAreZero() {
        _mm_setcsr(before_ | 0x8040);
    }
    ~DenormalsAreZero() {
        _mm_setcsr(before_);
    }
    DenormalsAreZero(const DenormalsAreZero&) = delete;
    DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

  private:
    unsigned before_ = _mm_getcsr();
#endif
};

}  // namespace space
