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

/// Finds records by where they are valid: within a reach of `accuracy` times their radius, and no
/// farther than the nearest surface that they know of. Those whose reach lies between two powers of
/// two share an octree of points, which is asked for all within the larger power.
class IrradianceCache {
  public:
    /// A record is used where its split-sphere error is below `accuracy`.
    explicit IrradianceCache(double accuracy) : accuracy_(accuracy) {}

    double accuracy() const { return accuracy_; }
    /// In the order in which they were added.
    std::span<const IrradianceRecord> records() const { return records_; }

    /// Radii shrink to nearest / accuracy where they are larger.
    /// @throws std::invalid_argument for a record whose position is not finite, whose radius is not
    /// finite (limit_radius makes it so), or whose reach is not positive
    void add(std::span<const IrradianceRecord> records) {
        for (const IrradianceRecord& record : records)
            if (!is_finite<3>(Point3(record.position)) || !std::isfinite(record.radius) ||
                !(record.radius > 0.0) || !(record.nearest > 0.0))
                throw std::invalid_argument(
                    "irradiance cache: a record that is valid nowhere or everywhere");
        for (IrradianceRecord record : records) {
            record.radius = std::min(record.radius, record.nearest / accuracy_);
            records_.push_back(record);
        }
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
            for_each_within(all, x, all.reach, [&](std::uint32_t index) {
                const IrradianceRecord& record = records_[index];
                const double error = split_sphere_error(record, x, n);
                if (error < accuracy_ && !lies_in_front(record, x, n)) visit(index, error);
            });
    }

    // [neighbour_clamp]
    /// A surface that one record has near it is no farther from another than the way between the
    /// two and that: lowers what each knows of the nearest by what its neighbours know (Krivanek,
    /// Bouatouch, Pattanaik and Zara 2006, "Making Radiance and Irradiance Caching Practical",
    /// section 4), and so its reach. A thin wall that few rays of one record meet, and none of
    /// another's, lets no light through. Ways by way of other records are no shorter, so once for
    /// each is enough. The same for any number of threads.
    void clamp_to_neighbours(unsigned threads) {
        std::vector<double> nearest(records_.size());
        parallel_for(nearest.size(), threads, 64, [&](std::size_t i) {
            const IrradianceRecord& record = records_[i];
            nearest[i] = record.nearest;
            for (const RadiusClass& all : classes_)  // whose nearest is half of the reach, or more
                for_each_within(
                    all, record.position, record.nearest - 0.5 * all.reach, [&](std::uint32_t j) {
                        const IrradianceRecord& other = records_[j];
                        const double way = glm::length(other.position - record.position);
                        nearest[i] = std::min(nearest[i], other.nearest + way);
                    });
        });
        for (std::size_t i = 0; i < nearest.size(); ++i) {
            records_[i].nearest = nearest[i];
            records_[i].radius = std::min(records_[i].radius, nearest[i] / accuracy_);
        }
        sort_into_classes();
    }
    // [neighbour_clamp]

  private:
    /// Records that reach less far than a power of two, but half as far or farther.
    struct RadiusClass {
        double reach;                        ///< a power of two
        std::vector<std::uint32_t> indices;  ///< of its records
        OrthtreePoints<3> tree;              ///< of these, in their order
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
            class_of(std::ldexp(1.0, exponent)).indices.push_back(i);
        }
        std::vector<Point3> points;
        for (RadiusClass& all : classes_) {
            points.clear();
            for (const std::uint32_t i : all.indices) points.emplace_back(records_[i].position);
            all.tree = OrthtreePoints<3>::build(std::span<const Point3>(points));
        }
    }
    RadiusClass& class_of(double reach) {
        const auto at = std::ranges::lower_bound(classes_, reach, {}, &RadiusClass::reach);
        if (at != classes_.end() && at->reach == reach) return *at;
        return *classes_.insert(at, {.reach = reach, .indices = {}, .tree = {}});
    }

    double accuracy_;
    std::vector<IrradianceRecord> records_;
    std::vector<RadiusClass> classes_;
};

}  // namespace space
