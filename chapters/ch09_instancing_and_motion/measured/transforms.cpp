#include "chapters/ch09_instancing_and_motion/measured/transforms.hpp"

#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/placement.hpp"
#include "chapters/ch09_instancing_and_motion/random_placement.hpp"
#include "common/measure.hpp"
#include "common/scene.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace space::ch09 {
namespace {

// ---- inverses ---------------------------------------------------------------------------------

/// Where q stands in the placement's local space, by the rotation's true inverse, in double.
Double3 true_local(const BasicPlacement<float>& placement, const glm::vec3& q) {
    return glm::inverse(glm::dmat3(placement.rotation)) *
           (Double3(q) - Double3(placement.translation)) / Double3(placement.scale);
}

double off(const glm::vec3& p, const Double3& truth) {
    const Double3 error = glm::abs(Double3(p) - truth);
    return 0x1p24 * std::max({error.x, error.y, error.z});
}

/// `next` gives a placement; each is tried with points of a cube that reaches from -1 to 1.
InverseError inverse_error(std::string name, std::size_t count,
                           const std::function<BasicPlacement<float>()>& next, Pcg32& random) {
    InverseError row{.placements = std::move(name)};
    for (std::size_t i = 0; i < count; ++i) {
        const BasicPlacement<float> placement = next();
        const glm::mat4 product = inverse_matrix(placement),
                        general = glm::inverse(matrix(placement));
        for (int k = 0; k < 8; ++k) {
            const glm::vec3 q = placement.to_world(random_vector(random));
            const Double3 truth = true_local(placement, q);
            row.parts = std::max(row.parts, off(placement.to_local(q), truth));
            row.product = std::max(row.product, off(product * glm::vec4(q, 1), truth));
            row.general = std::max(row.general, off(general * glm::vec4(q, 1), truth));
        }
    }
    return row;
}

glm::mat3 turned_often(Pcg32& random, int turns) {
    glm::mat3 rotation(1.0f);
    for (int i = 0; i < turns; ++i) rotation = glm::mat3(random_rotation(random)) * rotation;
    return rotation;
}

std::vector<InverseError> inverse_errors(std::uint64_t seed, std::size_t count) {
    Pcg32 random(seed);
    const auto placed = [&](double far, double stretch) {
        return [&random, far, stretch] { return rounded(random_placement(random, far, stretch)); };
    };
    std::vector<InverseError> rows;
    rows.push_back(inverse_error("turned", count, placed(0, 1), random));
    rows.push_back(inverse_error("moved by up to 1", count, placed(1, 1), random));
    rows.push_back(inverse_error("moved by up to 1,000", count, placed(1e3, 1), random));
    rows.push_back(inverse_error("moved by up to 1,000,000", count, placed(1e6, 1), random));
    rows.push_back(inverse_error("scaled by 1 to 1,000", count, placed(0, 1e3), random));
    rows.push_back(inverse_error(
        "turned 1,000 times", std::max<std::size_t>(count / 100, 1),
        [&] { return BasicPlacement<float>{.rotation = turned_often(random, 1000)}; }, random));
    return rows;
}

// ---- times ------------------------------------------------------------------------------------

/// `operation` on each of the inputs; what it makes is kept side by side, as in a scene.
template <class Inputs, class Operation>
std::function<void()> on_all(const Inputs& inputs, const Operation& operation) {
    using Result = decltype(operation(inputs.front()));
    return [&inputs, operation, results = std::vector<Result>(inputs.size())]() mutable {
        for (int round = 0; round < 50; ++round) {
            for (std::size_t i = 0; i < inputs.size(); ++i) results[i] = operation(inputs[i]);
            do_not_optimize(results.data());
        }
    };
}

template <class Real>
struct RayIn {
    glm::vec<3, Real> origin, direction;
};

template <class Real>
std::array<double, 4> transform_times(std::uint64_t seed) {
    constexpr std::size_t count = 1000;
    std::vector<BasicPlacement<Real>> placements;
    std::vector<glm::mat<4, 4, Real>> matrices, inverses;
    Pcg32 random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const ObjectPlacement placement = random_placement(random, 1, 2);
        placements.push_back({.translation = glm::vec<3, Real>(placement.translation),
                              .rotation = glm::mat<3, 3, Real>(placement.rotation),
                              .scale = glm::vec<3, Real>(placement.scale)});
        matrices.push_back(matrix(placements.back()));
        inverses.push_back(inverse_matrix(placements.back()));
    }
    const RayIn<Real> ray{.origin = {1, 2, 3}, .direction = {3, 2, 1}};
    const std::array<std::function<void()>, 4> candidates{
        on_all(placements, [](const auto& p) { return inverse_matrix(p); }),
        on_all(matrices, [](const auto& m) { return glm::inverse(m); }),
        on_all(placements,
               [ray](const auto& p) {
                   return RayIn<Real>{p.to_local(ray.origin), p.direction_to_local(ray.direction)};
               }),
        on_all(inverses, [ray](const auto& m) {
            return RayIn<Real>{m * glm::vec<4, Real>(ray.origin, 1),
                               m * glm::vec<4, Real>(ray.direction, 0)};
        })};
    std::array<double, 4> ns;
    const std::vector<double> ms = interleaved_medians(candidates, 15);
    for (std::size_t i = 0; i < ns.size(); ++i) ns[i] = 1e6 * ms[i] / (50.0 * double(count));
    return ns;
}

std::vector<TransformTime> times_of_all(std::uint64_t seed) {
    const auto in_float = transform_times<float>(seed);
    const auto in_double = transform_times<double>(seed);
    const std::array<std::string, 4> names{
        "the matrix S⁻¹ Rᵀ T⁻¹, from T, R, S", "the general inverse of a 4 x 4 matrix",
        "a ray to local space by T, R, S", "a ray to local space by a stored matrix"};
    std::vector<TransformTime> times;
    for (std::size_t i = 0; i < names.size(); ++i)
        times.push_back({names[i], in_float[i], in_double[i]});
    return times;
}

// ---- drift ------------------------------------------------------------------------------------

template <class Real>
double not_orthogonal(const glm::mat<3, 3, Real>& rotation) {
    const glm::dmat3 r(rotation), product = r * glm::transpose(r);
    double most = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) most = std::max(most, std::abs(product[i][j] - (i == j)));
    return most;
}

/// Medians over `trials` products of random rotations.
std::vector<Drift> drifts(std::uint64_t seed, std::size_t trials, std::uint64_t most) {
    std::vector<Drift> rows;
    for (std::uint64_t turns = 1; turns <= most; turns *= 10) {
        std::vector<double> in_float, made_orthonormal, in_double;
        for (std::size_t trial = 0; trial < trials; ++trial) {
            Pcg32 random(seed, trial);
            glm::mat3 a(1.0f), b(1.0f);
            glm::dmat3 c(1.0);
            for (std::uint64_t i = 0; i < turns; ++i) {
                const glm::dmat3 turn = random_rotation(random);
                a = glm::mat3(turn) * a;
                b = orthonormal(glm::mat3(turn) * b);
                c = turn * c;
            }
            in_float.push_back(not_orthogonal(a));
            made_orthonormal.push_back(not_orthogonal(b));
            in_double.push_back(not_orthogonal(c));
        }
        rows.push_back({turns, median(in_float), median(made_orthonormal), median(in_double)});
    }
    return rows;
}

// ---- normals and winding ----------------------------------------------------------------------

double degrees_between(const Double3& a, const Double3& b) {
    return 180.0 / std::numbers::pi * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Points of the unit sphere, stretched along x; each is seen from a direction of its own.
StretchedNormals stretched_normals(double stretch, std::size_t count, std::uint64_t seed) {
    StretchedNormals row{.stretch = stretch};
    row.derived = 180.0 / std::numbers::pi * std::atan(0.5 * (stretch - 1.0 / stretch));
    const glm::dmat3 m(Double3(stretch, 0, 0), Double3(0, 1, 0), Double3(0, 0, 1));
    Pcg32 random(seed);
    std::size_t visible = 0, away = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Double3 p = random_direction(random);
        const Double3 towards = random_direction(random);
        const Double3 truth(p.x / stretch, p.y, p.z);  // half the gradient of (x/s)^2 + y^2 + z^2
        row.by_matrix = std::max(row.by_matrix, degrees_between(m * p, truth));
        row.by_transposed = std::max(row.by_transposed, degrees_between(world_normal(m, p), truth));
        if (glm::dot(truth, towards) <= 0.0) continue;
        ++visible;
        away += glm::dot(m * p, towards) <= 0.0;
    }
    row.turned_away = double(away) / double(visible);
    return row;
}

/// Spheres whose triangles' front is outside, placed and flattened; each triangle is looked at from
/// one direction.
Winding winding(unsigned negative, std::size_t spheres, std::uint64_t seed) {
    const std::vector<Triangle> sphere = make_scene("icosphere:3").mesh.triangles();
    Winding row{.negative = negative};
    Pcg32 random(seed);
    for (std::size_t i = 0; i < spheres; ++i) {
        ObjectPlacement placement = random_placement(random, 10, 2);
        for (unsigned axis = 0; axis < negative; ++axis) placement.scale[int(axis)] *= -1.0;
        const Affine to_world = affine(placement);
        for (const Triangle& local : sphere) {
            const Triangle world = flattened(to_world, local);
            const Double3 n = normal(world),
                          middle = (Double3(world.a) + Double3(world.b) + Double3(world.c)) / 3.0;
            const bool inwards = glm::dot(n, middle - placement.translation) < 0.0;
            const Double3 direction = random_direction(random);
            const bool from_outside = (glm::dot(n, direction) < 0.0) != inwards,
                       plain = glm::dot(n, direction) < 0.0,
                       corrected = plain != (determinant(to_world) < 0.0);
            ++row.triangles;
            row.inwards += inwards;
            row.seen_wrong += plain != from_outside;
            row.corrected_wrong += corrected != from_outside;
        }
    }
    return row;
}

}  // namespace

TransformMeasurements measure_transforms(const Options& options) {
    const bool small = options.amount() == Amount::small;
    TransformMeasurements measured;
    measured.inverses = inverse_errors(options.seed, small ? 100 : 20'000);
    if (!small && !options.counts) measured.times = times_of_all(options.seed);
    measured.drifts = drifts(options.seed, small ? 3 : 101, small ? 100 : 10'000);
    for (const double stretch : {1.1, 2.0, 4.0, 10.0})
        measured.normals.push_back(
            stretched_normals(stretch, small ? 1000 : 1'000'000, options.seed));
    for (unsigned negative = 0; negative <= 3; ++negative)
        measured.windings.push_back(winding(negative, small ? 10 : 400, options.seed));
    return measured;
}

}  // namespace space::ch09
