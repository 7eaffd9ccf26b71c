/// @file
/// Naive tracing with one fault each: the suite must catch them, and call them by name.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"

#include <unistd.h>

#include <cstdlib>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace space {

enum class Flaw {
    none,
    drops_a_triangle,
    prunes_too_early,  ///< takes the hit of the first "leaf" of four triangles that has one
    ignores_tmin,
    ignores_tmax,
    open_interval,
    forgets_ties,  ///< keeps the last of equally near triangles
    stale_uv,      ///< u and v of the hit found before
    invents_hits,  ///< hits the whole plane's half around a triangle: u + v is not checked
    any_ignores_tmin,
    any_ignores_tmax,
    any_misses,            ///< any_hit skips the last triangle
    answers_invalid_rays,  ///< an interval that holds nothing is turned round
    counting_matters,      ///< one triangle fewer when nobody counts
    counts_nothing,
    wrong_shape,    ///< more leaves than nodes
    builds_differ,  ///< every second build drops its first triangle
    crashes_on_empty,
    throws_on_empty,
    hangs_on_empty,
    state_between_rays,  ///< answers a ray like the one before, now and then
};

template <Flaw flaw>
class Broken {
  public:
    static Broken build(std::span<const Triangle> triangles) {
        static int builds = 0;
        ++builds;
        Broken broken;
        if (triangles.empty()) {
            if (flaw == Flaw::crashes_on_empty) std::abort();
            if (flaw == Flaw::throws_on_empty) throw std::out_of_range("no first triangle");
            if (flaw == Flaw::hangs_on_empty)
                for (;;) ::pause();
        }
        broken.triangles_.assign(triangles.begin(), triangles.end());
        if (flaw == Flaw::builds_differ)
            broken.first_ = builds % 2 == 0 && triangles.size() > 1 ? 1 : 0;
        return broken;
    }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& given, Counts& counts) const {
        Ray ray = given;
        if (flaw == Flaw::answers_invalid_rays && ray.tmin > ray.tmax)
            std::swap(ray.tmin, ray.tmax);
        if (!is_valid(ray)) return std::nullopt;
        if (flaw == Flaw::ignores_tmin) ray.tmin = -infinity;
        if (flaw == Flaw::ignores_tmax) ray.tmax = infinity;
        if (flaw == Flaw::state_between_rays && ++calls_ % 7 == 0) return last_;

        std::optional<Hit> nearest;
        float u = 0.0f, v = 0.0f;
        for (std::uint32_t i = first_; i < triangles_.size(); ++i) {
            if (flaw == Flaw::drops_a_triangle && i == 2) continue;
            if (flaw == Flaw::prunes_too_early && nearest && i % 4 == 0) break;
            if (flaw == Flaw::counting_matters && std::is_same_v<Counts, NoCounts> && i == 2)
                continue;
            if (flaw != Flaw::counts_nothing) counts.test_triangle();
            std::optional<Hit> hit = intersect(ray, triangles_[i]);
            if (!hit) continue;
            hit->triangle = i;
            const bool better = !nearest || (flaw == Flaw::forgets_ties ? hit->t <= nearest->t
                                                                        : nearer(*hit, *nearest));
            if (!better) continue;
            if (flaw == Flaw::stale_uv) {
                std::swap(hit->u, u);
                std::swap(hit->v, v);
            }
            nearest = hit;
        }
        if (flaw == Flaw::state_between_rays) last_ = nearest;
        return nearest;
    }

    template <class Counts>
    bool any_hit(const Ray& given, Counts& counts) const {
        Ray ray = given;
        if (!is_valid(ray))
            return flaw == Flaw::answers_invalid_rays && closest_hit(ray, counts).has_value();
        if (flaw == Flaw::any_ignores_tmin) ray.tmin = -infinity;
        if (flaw == Flaw::any_ignores_tmax) ray.tmax = infinity;
        for (std::uint32_t i = first_; i < triangles_.size(); ++i) {
            if (flaw == Flaw::any_misses && i + 1 == triangles_.size()) continue;
            if (flaw == Flaw::drops_a_triangle && i == 2) continue;
            if (flaw != Flaw::counts_nothing) counts.test_triangle();
            if (intersect(ray, triangles_[i])) return true;
        }
        return false;
    }

    TreeShape shape() const {
        TreeShape shape{.references = triangles_.size(), .bytes = sizeof *this};
        if (flaw == Flaw::wrong_shape) shape.nodes = 1, shape.leaves = 2, shape.depth = 1;
        return shape;
    }

  private:
    static std::optional<Hit> intersect(const Ray& ray, const Triangle& triangle) {
        std::optional<Hit> hit = FilteredExact::intersect(ray, triangle);
        if (flaw == Flaw::open_interval && hit && (hit->t == ray.tmin || hit->t == ray.tmax))
            return std::nullopt;
        if (flaw == Flaw::invents_hits && !hit) {
            const Point3 fourth =
                triangle.b + (triangle.c - triangle.a);  // the parallelogram's other half
            return FilteredExact::intersect(ray, {triangle.b, fourth, triangle.c});
        }
        return hit;
    }

    std::vector<Triangle> triangles_;
    std::uint32_t first_ = 0;
    static inline thread_local std::uint64_t calls_ = 0;
    static inline thread_local std::optional<Hit> last_;
};

}  // namespace space
