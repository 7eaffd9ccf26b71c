/// Prints fingerprints of scenes, camera rays, hits and pictures. Compiled with several options and
/// compilers; a test compares what they print, line by line.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

constexpr int width = 24, height = 18;

/// FNV-1a over the bytes of values that have no padding between them.
template <class T>
std::uint64_t fingerprint(const std::vector<T>& values) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::byte byte : std::as_bytes(std::span(values)))
        hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3u;
    return hash;
}

}  // namespace

int main() {
    for (const space::SceneRecipe& recipe : space::scene_recipes()) {
        if (recipe.from_file) continue;  // which need not be there
        const space::Scene scene = space::make_scene(recipe.name, 1, true);
        const space::Naive<> naive = space::Naive<>::build(scene.mesh.triangles());
        const space::CameraFrame frame(scene.camera);
        std::vector<glm::vec3> directions, hits;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const space::Ray ray =
                    space::camera_ray(scene.camera, frame, x + 0.5, y + 0.5, width, height);
                const auto hit = space::closest_hit(naive, ray);
                directions.push_back(ray.direction);
                if (hit) hits.push_back({hit->t, hit->u, hit->v});
            }
        const space::Rendering picture =
            space::render(scene, naive, {.width = width, .height = height});
        fmt::print(
            "{}: vertices {:016x} faces {:016x} colors {:016x} rays {:016x} hits {} {:016x} "
            "picture {:016x}\n",
            recipe.name, fingerprint(scene.mesh.vertices), fingerprint(scene.mesh.faces),
            fingerprint(scene.colors), fingerprint(directions), hits.size(), fingerprint(hits),
            fingerprint(space::srgb_bytes(picture.image)));
    }
}
