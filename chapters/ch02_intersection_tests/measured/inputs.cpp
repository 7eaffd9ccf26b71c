#include "chapters/ch02_intersection_tests/measured/inputs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace space::ch02 {

// --- triangles ---

const std::vector<TriangleInput>& triangle_inputs() {
    static const std::vector<TriangleInput> all{
        {"random", Aim::around},
        {"edges", Aim::edge},
        {"vertices", Aim::vertex},
        {"grazing", Aim::grazing},
        {"near", Aim::near},
        {"distant", Aim::distant},
        {"uneven", Aim::uneven},
        {"shifted 10^3", Aim::around, 0, 3},
        {"shifted 10^5", Aim::around, 0, 5},
        {"shifted 10^7", Aim::around, 0, 7},
        {"scaled 10^-20", Aim::around, -20},
        {"scaled 10^-10", Aim::around, -10},
        {"scaled 10^10", Aim::around, 10},
        {"scaled 10^20", Aim::around, 20},
    };
    return all;
}

namespace {

/// The triangle and the ray from origin to target, scaled and shifted as the input says, in float.
RayAndTriangle placed_pair(const TriangleInput& input, const Double3 (&corner)[3],
                           const Double3& origin, const Double3& target, const Double3& away,
                           Pcg32& random) {
    const double stretch =
        random.below(2) ? 1.0 : 0.5 + random.uniform_double();  // 1: t = 1 at the target
    const double scale = std::pow(10.0, input.scale);
    const Double3 shift =
        input.shift == 0 ? Double3(0.0) : std::pow(10.0, input.shift) * Double3(1.0, 0.5, -0.25);
    const auto placed = [&](const Double3& p) { return Point3(scale * p + shift); };
    const Point3 from = placed(origin), to = placed(target);
    Vector3 direction(stretch * Double3(to - from));
    if (direction == Vector3(0.0f)) direction = Vector3(-away);  // rounded to the same point
    return {{.origin = from, .direction = direction},
            {placed(corner[0]), placed(corner[1]), placed(corner[2])}};
}

}  // namespace

RayAndTriangle make_pair(const TriangleInput& input, Pcg32& random) {
    Double3 corner[3] = {Double3(random_vector(random)), Double3(random_vector(random)),
                         Double3(random_vector(random))};
    if (input.aim == Aim::uneven)
        for (Double3& p : corner) p *= std::pow(10.0, static_cast<int>(random.below(17)) - 8);
    const auto point = [&](double u, double v) {
        return corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]);
    };
    const auto inside = [&] {
        const double u = random.uniform_double(), v = random.uniform_double();
        return u + v <= 1.0 ? point(u, v) : point(1.0 - u, 1.0 - v);
    };
    const Double3 away = random_direction(random);
    const double distance = 1.0 + 3.0 * random.uniform_double();
    Double3 target, origin;
    switch (input.aim) {
        case Aim::around: {
            const double u = 2.0 * random.uniform_double() - 0.5,
                         v = 2.0 * random.uniform_double() - 0.5;
            target = point(u, v);
            origin = target + distance * away;
            break;
        }
        case Aim::edge:
        case Aim::uneven: {
            const std::uint32_t side = random.below(3);
            target =
                corner[side] + random.uniform_double() * (corner[(side + 1) % 3] - corner[side]);
            origin = target + distance * away;
            break;
        }
        case Aim::vertex:
            target = corner[random.below(3)];
            origin = target + distance * away;
            break;
        case Aim::grazing: {
            target = inside();
            const Double3 n =
                glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
            const Double3 along = glm::normalize(away - glm::dot(away, n) * n);
            origin = target + distance * (along + 1e-3 * (2.0 * random.uniform_double() - 1.0) * n);
            break;
        }
        case Aim::near:
            target = inside();
            origin = target + 1e-3 * distance * away;
            break;
        case Aim::distant:
            target = inside();
            origin = target + 1e4 * distance * away;
            break;
    }
    return placed_pair(input, corner, origin, target, away, random);
}

TriangleMesh bumpy_ball(int levels) {
    using Face = std::array<std::uint32_t, 3>;
    std::vector<Double3> corners{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                 {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    std::vector<Face> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                            {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (; levels > 0; --levels) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>
            middles;  // of edges; shared by both faces
        const auto middle = [&](std::uint32_t i, std::uint32_t j) {
            const auto [entry, is_new] =
                middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(corners.size()));
            if (is_new) corners.push_back(glm::normalize(corners[i] + corners[j]));
            return entry->second;
        };
        std::vector<Face> finer;
        for (const auto& [a, b, c] : faces) {
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const Face& part : {Face{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
                finer.push_back(part);
        }
        faces = std::move(finer);
    }
    TriangleMesh mesh{.vertices = {}, .faces = std::move(faces)};
    for (const Double3& p : corners)  // bumps by a polynomial: no transcendental functions
        mesh.vertices.push_back(
            Point3(p * (0.9 + 0.8 * p.x * p.y * p.z + 0.15 * p.x + 0.2 * p.y * p.y)));
    return mesh;
}

// --- boxes ---

std::vector<RayAndBox> lattice_boxes() {
    std::vector<RayAndBox> all;
    const float directions[] = {-1.0f, -0.0f, 0.0f, 1.0f};
    for (int o = 0; o < 125; ++o)
        for (int d = 0; d < 64; ++d) {
            const Point3 origin(o % 5 - 1, o / 5 % 5 - 1, o / 25 - 1);
            const Vector3 direction(directions[d % 4], directions[d / 4 % 4], directions[d / 16]);
            if (direction != Vector3(0.0f))
                all.push_back({{origin, direction}, {Point3(0.0f), Point3(2.0f)}});
        }
    return all;
}

RayAndBox make_box_pair(Pcg32& random) {
    const Point3 p = random_vector(random), q = random_vector(random);
    Aabb box{glm::min(p, q), glm::max(p, q)};
    const std::uint32_t flat = random.below(12), parallel = random.below(12);  // an axis, or none
    if (flat < 3) box.max[flat] = box.min[flat];
    Double3 target;
    for (int axis = 0; axis < 3; ++axis) {  // at an end of the box, or between
        const std::uint32_t place = random.below(3);
        const double share = place == 0 ? 0.0 : place == 1 ? 1.0 : random.uniform_double();
        target[axis] = box.min[axis] + share * (double{box.max[axis]} - box.min[axis]);
    }
    const double distance = 1.0 + 7.0 * random.uniform_double();
    Ray ray{.origin = Point3(target + distance * random_direction(random))};
    if (parallel < 3) ray.origin[parallel] = static_cast<float>(target[parallel]);
    // Of any length: where the corner is at t = 1 exactly, a division cannot be wrong.
    ray.direction = Vector3((0.5 + random.uniform_double()) * Double3(Point3(target) - ray.origin));
    if (parallel < 3 && random.below(2))
        ray.direction[parallel] = -ray.direction[parallel];  // +0 or -0
    return {ray, box};
}

}  // namespace space::ch02
