// The lab with a structure that is broken on purpose: --check must find it.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch12_comparison/lab.hpp"
#include "common/program/error.hpp"

#include <new>
#include <stdexcept>

namespace {

/// Triangle 7 is lost.
struct DropsATriangle {
    using Config = space::Naive<>::Config;
    space::Naive<> naive;

    static DropsATriangle build(std::span<const space::Triangle> triangles, const Config& config) {
        std::vector<space::Triangle> kept(triangles.begin(), triangles.end());
        kept.at(7) = {};  // no area: never hit
        return {space::Naive<>::build(kept, config)};
    }
    template <class Counts>
    std::optional<space::Hit> closest_hit(const space::Ray& ray, Counts& counts) const {
        return naive.closest_hit(ray, counts);
    }
    template <class Counts>
    bool any_hit(const space::Ray& ray, Counts& counts) const {
        return naive.any_hit(ray, counts);
    }
    space::TreeShape shape() const { return naive.shape(); }
};

space::BuiltStructure no_memory(std::span<const space::Triangle>, const space::BuildOptions&) {
    throw std::bad_alloc();
}

/// Stands, but throws at the first ray.
space::BuiltStructure no_trace(std::span<const space::Triangle> triangles,
                               const space::BuildOptions& options) {
    space::BuiltStructure built = space::build_structure<space::Naive<>>(triangles, options);
    built.trace = [](const space::Batch&) { throw std::runtime_error("no way through"); };
    return built;
}

int lab(int argc, char** argv) {
    using space::MollerTrumbore, space::Naive, space::build_structure;
    const std::vector<space::Structure> structures{
        {"naive",
         "the trusted one",
         {{"moller-trumbore", "", build_structure<Naive<MollerTrumbore>>}}},
        {"broken", "loses triangle 7", {{"moller-trumbore", "", build_structure<DropsATriangle>}}},
        {"no-memory", "", {{"moller-trumbore", "", no_memory}}},
        {"no-trace", "", {{"moller-trumbore", "", no_trace}}},
    };
    return space::run_lab(structures, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
    return space::run_program("lab", lab, argc, argv);
}
