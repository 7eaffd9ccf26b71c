// The lab with a structure that is broken on purpose: --check must find it.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch12_comparison/lab.hpp"
#include "common/program/error.hpp"

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

int lab(int argc, char** argv) {
    using space::MollerTrumbore, space::Naive, space::build_structure;
    const std::vector<space::Structure> structures{
        {"naive",
         "the trusted one",
         {{"moller-trumbore", "", build_structure<Naive<MollerTrumbore>>}}},
        {"broken", "loses triangle 7", {{"moller-trumbore", "", build_structure<DropsATriangle>}}},
    };
    return space::run_lab(structures, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
    return space::run_program("lab", lab, argc, argv);
}
