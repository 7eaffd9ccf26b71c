/// @file
/// Rays at the edges of fragments: which of them slip through.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch03/cgal_fragments.hpp"
#include "tests/oracle/exact.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace space {

/// Of many rays.
struct Leaks {
    std::uint64_t aimed = 0;
    std::uint64_t hits = 0;   ///< rays that hit a triangle near the point aimed at, exactly
    std::uint64_t leaks = 0;  ///< of these: no fragment of a triangle near that point is met
    /// And of these: all triangles near that point face the same way. At a silhouette a cut that
    /// rounding moved inwards lets rays past without a crack.
    std::uint64_t through = 0;
    std::uint64_t unmet = 0;  ///< triangles that are hit, none of whose fragments is met
    std::uint64_t exact_decisions = 0;
    std::vector<Ray> leaking;

    Leaks& operator+=(const Leaks& other) {
        aimed += other.aimed;
        hits += other.hits;
        leaks += other.leaks;
        through += other.through;
        unmet += other.unmet;
        exact_decisions += other.exact_decisions;
        leaking.insert(leaking.end(), other.leaking.begin(), other.leaking.end());
        return *this;
    }
};

/// Shoots at the edges of fragments, and asks only the triangles near the point that is aimed at: a
/// far side hides no leak.
class Gallery {
  public:
    /// The first `closed` polygons are aimed at.
    Gallery(const FragmentsView<3>& view, std::size_t closed)
        : polygons_(view.polygons), fragments_(view), of_(view.polygons.size()) {
        std::map<std::array<float, 3>, std::vector<std::uint32_t>> at;  // triangles by vertex
        const auto key = [](const Point3& p) { return std::array{p.x, p.y, p.z}; };
        for (std::uint32_t i = 0; i < view.polygons.size(); ++i)
            for (int corner = 0; corner < 3; ++corner) {
                at[key(view.polygons[i][corner])].push_back(i);
                if (i < closed) box_.extend(view.polygons[i][corner]);
            }
        for (const Triangle& polygon : view.polygons) {
            std::vector<std::uint32_t> ring;
            for (int corner = 0; corner < 3; ++corner)
                for (const std::uint32_t i : at[key(polygon[corner])])
                    if (std::find(ring.begin(), ring.end(), i) == ring.end()) ring.push_back(i);
            near_.push_back(std::move(ring));
        }
        for (std::uint32_t i = 0; i < view.fragments.size(); ++i) {
            const Fragment<3>& f = view.fragments[i];
            of_[f.polygon].push_back(i);
            if (f.polygon >= closed) continue;
            for (std::size_t c = 0; c < f.corners.size(); ++c)
                (f.corners[c].carriers.back().is_original() ? old_ : cut_)
                    .push_back(
                        {f.corners[c].at, f.corners[(c + 1) % f.corners.size()].at, f.polygon});
        }
    }

    Leaks at_old_edges(int rays, std::uint64_t seed) const { return shoot(old_, rays, seed); }
    Leaks at_cuts(int rays, std::uint64_t seed) const { return shoot(cut_, rays, seed); }

  private:
    struct Edge {
        Double3 from, to;
        std::uint32_t polygon;
    };

    Leaks shoot(const std::vector<Edge>& edges, int rays, std::uint64_t seed) const {
        Leaks leaks;
        if (edges.empty()) return leaks;
        const std::uint64_t before = fragments_.exact_decisions();
        Pcg32 random(seed);
        const Vector3 extent = box_.extent();
        const auto origin = [&]() -> Point3 {
            for (;;) {  // outside of the box by up to its size; some on the grid that whole numbers
                        // lie on
                Point3 p = box_.min + random_point(random, -1.0f, 2.0f) * extent;
                if (random.below(4) == 0) p = glm::floor(p * 4.0f) * 0.25f;
                if (!box_.contains(p)) return p;
            }
        };
        for (int i = 0; i < rays; ++i) {
            const Edge& edge = edges[random.below(static_cast<std::uint32_t>(edges.size()))];
            const double s = random.below(8) == 0   ? 0.0
                             : random.below(4) == 0 ? 0.5
                                                    : random.uniform_double();
            const Point3 from = origin();
            aim({from, Vector3(edge.from + s * (edge.to - edge.from) - Double3(from))},
                edge.polygon, leaks);
        }
        leaks.exact_decisions = fragments_.exact_decisions() - before;
        return leaks;
    }

    void aim(const Ray& ray, std::uint32_t polygon, Leaks& leaks) const {
        ++leaks.aimed;
        bool hit = false, met = false, towards = false, away = false;
        for (const std::uint32_t near : near_[polygon]) {
            const bool meets =
                std::any_of(of_[near].begin(), of_[near].end(),
                            [&](std::uint32_t f) { return fragments_.meets(ray, f); });
            const Triangle& p = polygons_[near];
            const bool hits = FilteredExact::intersect(ray, p).has_value();
            hit = hit || hits;
            met = met || meets;
            leaks.unmet += hits && !meets;
            const bool front = glm::dot(normal(p), Double3(ray.direction)) < 0.0;
            (front ? towards : away) = true;
        }
        leaks.hits += hit;
        leaks.leaks += hit && !met;
        leaks.through += hit && !met && towards != away;
        if (hit && !met) {  // judged again by the oracle
            bool confirmed = false;
            for (const std::uint32_t near : near_[polygon]) {
                const Triangle& p = polygons_[near];
                confirmed = confirmed || decide(ray, p) != Place::miss;
            }
            REQUIRE(confirmed);
            leaks.leaking.push_back(ray);
        }
    }

    std::span<const Triangle> polygons_;
    CgalFragments fragments_;
    Aabb box_;
    std::vector<std::vector<std::uint32_t>>
        near_;  ///< of each triangle: those that share a vertex with it, itself too
    std::vector<std::vector<std::uint32_t>> of_;  ///< of each triangle: its fragments
    std::vector<Edge> old_, cut_;
};

}  // namespace space
