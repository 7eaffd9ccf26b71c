#include "chapters/ch07_bounding_volume_hierarchies/measured/series.hpp"

#include "common/geometry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace space::ch07 {

std::string Target::verdict() const {
    std::vector<std::string_view> short_of;
    if (!is_built()) short_of.push_back("build");
    if (!is_seen()) short_of.push_back("camera");
    if (!is_lit()) short_of.push_back("diffuse");
    if (!is_small()) short_of.push_back("bytes");
    if (!is_split()) short_of.push_back("splits");
    return short_of.empty() ? "met" : fmt::format("short: {}", fmt::join(short_of, ", "));
}

std::vector<Target> targets(const std::vector<TreePoint>& trees) {
    std::vector<Target> all;
    for (const std::string& scene : scenes_of(trees)) {
        const TreePoint *ours = tree_of(trees, scene, by_bins),
                        *peer = tree_of(trees, scene, embree),
                        *split = tree_of(trees, scene, by_spatial);
        if (!ours || !peer || !split) continue;
        Target target{.scene = scene,
                      .n = ours->n,
                      .is_long = ours->is_long,
                      .is_soup = scene.starts_with("soup"),
                      .build = ours->build_ms / peer->build_ms,
                      .bytes = ours->bytes_per_triangle(),
                      .spatial_gain = split->diffuse().per_second() / ours->diffuse().per_second()};
        for (std::size_t kind = 0; kind < ray_kinds.size(); ++kind)
            target.rays[kind] = ours->rays[kind].per_second() / peer->rays[kind].per_second();
        all.push_back(target);
    }
    return all;
}

std::vector<CostFit> fit_costs(const std::vector<LeafPoint>& leaves) {
    std::vector<CostFit> fits;
    for (const std::string& scene : scenes_of(leaves)) {
        std::vector<LeafPoint> some = leaves;
        std::erase_if(some, [&](const LeafPoint& p) { return p.scene != scene || p.ms <= 0.0; });
        if (some.size() < 3) continue;
        // Least squares of the relative errors: each row is divided by its time.
        glm::dmat3 normal(0.0);
        Double3 right(0.0);
        const auto row_of = [](const LeafPoint& p) {
            return Double3(1.0, p.inner_per_ray(), p.tests_per_ray()) / p.ns_per_ray();
        };
        for (const LeafPoint& p : some) {
            normal += glm::outerProduct(row_of(p), row_of(p));
            right += row_of(p);
        }
        const Double3 found = glm::inverse(normal) * right;
        CostFit fit{.scene = scene, .ray_ns = found.x, .node_ns = found.y, .test_ns = found.z};
        for (const LeafPoint& p : some)
            fit.largest_error =
                std::max(fit.largest_error, std::abs(glm::dot(row_of(p), found) - 1.0));
        fits.push_back(fit);
    }
    return fits;
}

}  // namespace space::ch07
