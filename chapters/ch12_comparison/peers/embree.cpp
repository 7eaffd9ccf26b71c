#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "chapters/ch12_comparison/peers/peers.hpp"

#include <fmt/format.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <atomic>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace space::ch12 {
namespace {

struct Flavour {
    RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
    RTCSceneFlags flags = RTC_SCENE_FLAG_NONE;
    const char* names = "RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE";
};

#if RTC_VERSION_MAJOR >= 4
void intersect(RTCScene scene, RTCRayHit& ray) {
    rtcIntersect1(scene, &ray);
}
void occluded(RTCScene scene, RTCRay& ray) {
    rtcOccluded1(scene, &ray);
}
#else
void intersect(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
}
void occluded(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
}
#endif

RTCRay rtc_ray(const Ray& ray) {
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

/// A device, a scene of one mesh, and the corners that the mesh shares with us. Throws what Embree
/// reports.
class EmbreeTree {
  public:
    EmbreeTree(std::span<const Triangle> triangles, unsigned threads, const Flavour& flavour)
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
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, flavour.quality);
        rtcSetSceneFlags(scene_, flavour.flags);
        attach(triangles);
        rtcCommitScene(scene_);
        if (!error_.empty()) {
            release();
            throw std::runtime_error("Embree: " + error_);
        }
    }
    ~EmbreeTree() { release(); }
    EmbreeTree(const EmbreeTree&) = delete;
    EmbreeTree& operator=(const EmbreeTree&) = delete;

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts&) const {
        if (!is_valid(ray)) return std::nullopt;
        RTCRayHit query{rtc_ray(ray), {}};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        intersect(scene_, query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        return Hit{
            .t = query.ray.tfar, .triangle = query.hit.primID, .u = query.hit.u, .v = query.hit.v};
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts&) const {
        if (!is_valid(ray)) return false;
        RTCRay query = rtc_ray(ray);
        occluded(scene_, query);
        return query.tfar == -infinity;
    }
    TreeShape shape() const {
        return {.references = count_,
                .bytes = static_cast<std::size_t>(bytes_) + corners_.capacity() * sizeof(float)};
    }

  private:
    void attach(std::span<const Triangle> triangles) {
        count_ = triangles.size();
        const RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        static_assert(sizeof(Triangle) == 9 * sizeof(float));
        corners_.resize(9 * count_ + 1);  // Embree reads 16 bytes at the last corner
        if (count_ > 0) std::memcpy(corners_.data(), triangles.data(), triangles.size_bytes());
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   corners_.data(), 0, 3 * sizeof(float), 3 * count_);
        if (auto* const indices = static_cast<std::uint32_t*>(
                rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                        3 * sizeof(std::uint32_t), count_)))
            for (std::uint32_t i = 0; i < 3 * count_; ++i) indices[i] = i;
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_, mesh);
        rtcReleaseGeometry(mesh);
    }
    void release() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    std::string error_;
    std::atomic<ssize_t> bytes_{0};
    std::vector<float> corners_;
    std::size_t count_ = 0;
    RTCDevice device_;
    RTCScene scene_ = nullptr;
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

Structure offer(std::string_view name, std::string_view about, Flavour flavour) {
    const auto build = [flavour](std::span<const Triangle> triangles, const BuildOptions& options) {
        const auto tree = std::make_shared<const EmbreeTree>(triangles, options.threads, flavour);
        return BuiltStructure{
            .shape = [tree] { return tree->shape(); },
            .trace =
                [tree](const Batch& batch) {
                    [[maybe_unused]] const DenormalsAreZero guard;
                    trace<NoCounts>(*tree, batch);
                },
            .build_threads = options.threads,
            .configuration = fmt::format("Embree {}, {}, threads={}, instruction set by default, "
                                         "rtcIntersect1 and rtcOccluded1, denormals are zero",
                                         RTC_VERSION_STRING, flavour.names, options.threads)};
    };
    return {.name = name, .about = about, .variants = {{"its own", "", build}}};
}

}  // namespace

Home embree() {
    return {"Embree " RTC_VERSION_STRING,
            {offer("embree", "Intel's bounding volume hierarchy, eight children a node", {}),
             offer("embree-high", "the same, built with spatial splits",
                   {RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE,
                    "RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE"}),
             offer("embree-robust", "as embree, watertight along edges",
                   {RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST,
                    "RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST"})},
            true};
}

}  // namespace space::ch12
