/// @file
/// A set of irradiance records in octrees, and what they tell of any point: the weighted mean of
/// those close enough by the split-sphere estimate (Ward, Rubinstein and Clear 1988, section 4).
#pragma once

#include "chapters/ch01_naive_ray_tracing/shading.hpp"  // float_roundoff
#include "chapters/ch06_quadtrees_and_octrees/orthtree_points.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_search.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance_record.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"
#include "common/parallel.hpp"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// Finds records by where they are valid: within `accuracy` times their radius. Those whose reach
/// lies between two powers of two share an octree of points, which is asked for all within the
/// larger power.
class IrradianceCache {
  public:
    /// A record is used where its split-sphere error is below `accuracy`.
    explicit IrradianceCache(double accuracy) : accuracy_(accuracy) {}

    double accuracy() const { return accuracy_; }
    /// In the order in which they were added.
    std::span<const IrradianceRecord> records() const { return records_; }

    /// @throws std::invalid_argument for a record whose position is not finite, or whose radius is
    /// not positive and finite (limit_radius makes it so)
    void add(std::span<const IrradianceRecord> records) {
        for (const IrradianceRecord& record : records)
            if (!is_finite<3>(Point3(record.position)) || !std::isfinite(record.radius) ||
                !(record.radius > 0.0))
                throw std::invalid_argument(
                    "irradiance cache: a record's position or radius is not "
                    "finite, or its radius not positive");
        records_.insert(records_.end(), records.begin(), records.end());
        sort_into_classes();
    }

    // [interpolate]
    /// What the valid records tell of the irradiance at x, on the side of the normal n (of length
    /// 1): each weighs 1 / error - 1 / accuracy, which falls to 0 where it ceases to be valid.
    /// Where a record lies at x itself, what that says. Nothing where none is valid.
    std::optional<Double3> irradiance(const Double3& x, const Double3& n) const {
        Double3 sum{0.0};
        double weights = 0.0;
        std::optional<std::uint32_t> at_x;
        for_each_valid(x, n, [&](std::uint32_t index, double error) {
            const double weight = 1.0 / error - 1.0 / accuracy_;
            if (!std::isfinite(weight)) {
                at_x = std::min(index, at_x.value_or(index));
                return;
            }
            sum += weight * extrapolated(records_[index], x, n);
            weights += weight;
        });
        if (at_x) return extrapolated(records_[*at_x], x, n);
        if (weights > 0.0) return sum / weights;
        return std::nullopt;
    }
    // [interpolate]

    /// Whether any record is valid there.
    bool covers(const Double3& x, const Double3& n) const {
        bool any = false;
        for_each_valid(x, n, [&](std::uint32_t, double) { any = true; });
        return any;
    }

    /// Calls visit(index, error) for each record that is valid at x on the side of n: by error, and
    /// because it does not lie in front.
    template <class Visit>
    void for_each_valid(const Double3& x, const Double3& n, const Visit& visit) const {
        for (const RadiusClass& all : classes_)
            for_each_within(all, x, all.reach(), [&](std::uint32_t index) {
                const IrradianceRecord& record = records_[index];
                const double error = split_sphere_error(record, x, n);
                if (error < accuracy_ && !lies_in_front(record, x, n)) visit(index, error);
            });
    }

    // [neighbour_clamp]
    /// What a record sees at a distance R, its neighbour at a distance d sees no farther than R +
    /// d: lowers each radius to that of any neighbour and the way to it (Krivanek, Bouatouch,
    /// Pattanaik and Zara 2006, "Making Radiance and Irradiance Caching Practical", section 4). So
    /// a few rays that meet a thin wall near one record keep others from reaching through it. Ways
    /// along several records are never shorter, so once for each is enough. The same for any number
    /// of threads.
    void clamp_to_neighbours(unsigned threads) {
        std::vector<double> radii(records_.size());
        parallel_for(radii.size(), threads, 64, [&](std::size_t i) {
            const IrradianceRecord& record = records_[i];
            radii[i] = record.radius;
            for (const RadiusClass& all : classes_)
                for_each_within(all, record.position, record.radius - 0.5 * all.reach() / accuracy_,
                                [&](std::uint32_t j) {
                                    const IrradianceRecord& other = records_[j];
                                    const double way =
                                        glm::length(other.position - record.position);
                                    radii[i] = std::min(radii[i], other.radius + way);
                                });
        });
        for (std::size_t i = 0; i < radii.size(); ++i) records_[i].radius = radii[i];
        sort_into_classes();
    }
    // [neighbour_clamp]

  private:
    /// Records that reach less far than a power of two, but half as far or farther.
    struct RadiusClass {
        int exponent;                        ///< of the farthest reach, a power of two
        std::vector<std::uint32_t> indices;  ///< of its records
        OrthtreePoints<3> tree;              ///< of these, in their order

        double reach() const { return std::ldexp(1.0, exponent); }
    };
    /// Calls visit(index) for what an octree's search comes to.
    template <class Visit>
    struct Visitor {
        float reach;  ///< squared
        const RadiusClass& all;
        const Visit& visit;

        void consider(float, std::uint32_t place) { visit(all.indices[all.tree.index(place)]); }
    };

    /// Visits all records of a class within a distance of x, and perhaps some that are a little
    /// farther: for the trees x and positions are rounded to floats, each by up to u24 of its
    /// largest coordinate on each axis.
    template <class Visit>
    static void for_each_within(const RadiusClass& all, const Double3& x, double distance,
                                const Visit& visit) {
        const Point3 query{x};
        if (!(distance > 0.0) || !is_finite<3>(query)) return;
        const Double3 size = glm::abs(x);
        const double largest = std::max({size.x, size.y, size.z}) + distance;
        const double reach = distance + 4.0 * float_roundoff * largest;
        Visitor<Visit> visitor{float_reach<3>(reach * reach), all, visit};
        NoObserver none;
        OrthtreeSearch<3>::run(all.tree, query, visitor, none);
    }

    void sort_into_classes() {
        classes_.clear();
        for (std::uint32_t i = 0; i < records_.size(); ++i) {
            int exponent;
            std::frexp(accuracy_ * records_[i].radius, &exponent);
            class_of(exponent).indices.push_back(i);
        }
        std::vector<Point3> points;
        for (RadiusClass& all : classes_) {
            points.clear();
            for (const std::uint32_t i : all.indices) points.emplace_back(records_[i].position);
            all.tree = OrthtreePoints<3>::build(std::span<const Point3>(points));
        }
    }
    RadiusClass& class_of(int exponent) {
        const auto at = std::ranges::lower_bound(classes_, exponent, {}, &RadiusClass::exponent);
        if (at != classes_.end() && at->exponent == exponent) return *at;
        return *classes_.insert(at, {.exponent = exponent, .indices = {}, .tree = {}});
    }

    double accuracy_;
    std::vector<IrradianceRecord> records_;
    std::vector<RadiusClass> classes_;
};

}  // namespace space
