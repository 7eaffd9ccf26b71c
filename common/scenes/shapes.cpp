#include "common/scenes/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace space {
namespace {

constexpr double pi = std::numbers::pi;

std::uint32_t count(const TriangleMesh& mesh) {
    return static_cast<std::uint32_t>(mesh.vertices.size());
}

void add_quad(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c,
              std::uint32_t d) {
    mesh.faces.push_back({a, b, c});
    mesh.faces.push_back({a, c, d});
}

/// Cosine and sine of the i-th of n equal parts of the circle.
glm::dvec2 on_circle(std::uint32_t i, std::uint32_t n) {
    const double angle = 2.0 * pi * i / n;
    return {std::cos(angle), std::sin(angle)};
}

// The icosahedron: (0, +-1, +-phi) and its cyclic permutations.
constexpr double phi = std::numbers::phi;
const Double3 corners[12] = {{-1, phi, 0}, {1, phi, 0}, {-1, -phi, 0}, {1, -phi, 0},
                             {0, -1, phi}, {0, 1, phi}, {0, -1, -phi}, {0, 1, -phi},
                             {phi, 0, -1}, {phi, 0, 1}, {-phi, 0, -1}, {-phi, 0, 1}};
constexpr std::uint32_t faces[20][3] = {
    {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};

}  // namespace

TriangleMesh icosphere(std::uint32_t frequency) {
    const std::uint32_t f = frequency;
    TriangleMesh mesh;
    mesh.vertices.reserve(10 * std::size_t{f} * f + 2);
    mesh.faces.reserve(20 * std::size_t{f} * f);
    const auto add_vertex = [&](const Double3& p) {
        mesh.vertices.push_back(Point3(glm::normalize(p)));
    };
    for (const Double3& corner : corners) add_vertex(corner);

    // Inner points of an edge, made when its first face comes: from its smaller to its larger
    // corner.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
    const auto edge_point = [&](std::uint32_t a, std::uint32_t b,
                                std::uint32_t step) {  // step of f from a to b
        if (a > b) {
            std::swap(a, b);
            step = f - step;
        }
        const auto [edge, fresh] = edges.try_emplace({a, b}, count(mesh));
        if (fresh)
            for (std::uint32_t i = 1; i < f; ++i)
                add_vertex(double(f - i) * corners[a] + double(i) * corners[b]);
        return edge->second + step - 1;
    };

    for (const auto& [a, b, c] : faces) {
        // Points of the face in rows from a to the edge bc; row r holds r + 1 points from the edge
        // ab to the edge ac.
        std::vector<std::uint32_t> row{a}, next;
        for (std::uint32_t r = 1; r <= f; ++r) {
            next.clear();
            for (std::uint32_t k = 0; k <= r; ++k) {
                if (r == f && k == 0)
                    next.push_back(b);
                else if (r == f && k == f)
                    next.push_back(c);
                else if (r == f)
                    next.push_back(edge_point(b, c, k));
                else if (k == 0)
                    next.push_back(edge_point(a, b, r));
                else if (k == r)
                    next.push_back(edge_point(a, c, r));
                else {
                    next.push_back(count(mesh));
                    add_vertex(double(f - r) * corners[a] + double(r - k) * corners[b] +
                               double(k) * corners[c]);
                }
            }
            for (std::uint32_t k = 0; k < r; ++k) {
                mesh.faces.push_back({row[k], next[k], next[k + 1]});
                if (k + 1 < r) mesh.faces.push_back({row[k], next[k + 1], row[k + 1]});
            }
            row.swap(next);
        }
    }
    return mesh;
}

TriangleMesh ball(const Double3& centre, double radius, std::uint32_t frequency) {
    return transformed(icosphere(frequency), glm::dmat3(radius), centre);
}

TriangleMesh box(const Double3& min, const Double3& max) {
    TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.vertices.emplace_back(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y,
                                   corner & 4 ? max.z : min.z);
    add_quad(mesh, 0, 4, 6, 2);  // -x
    add_quad(mesh, 1, 3, 7, 5);  // +x
    add_quad(mesh, 0, 1, 5, 4);  // -y
    add_quad(mesh, 2, 6, 7, 3);  // +y
    add_quad(mesh, 0, 2, 3, 1);  // -z
    add_quad(mesh, 4, 5, 7, 6);  // +z
    return mesh;
}

TriangleMesh parallelogram(const Double3& corner, const Double3& u, const Double3& v) {
    TriangleMesh mesh;
    for (const Double3& p : {corner, corner + u, corner + u + v, corner + v})
        mesh.vertices.emplace_back(p);
    add_quad(mesh, 0, 1, 2, 3);
    return mesh;
}

TriangleMesh lathe(std::span<const glm::dvec2> profile, std::uint32_t segments) {
    TriangleMesh mesh;
    std::uint32_t below = 0;
    for (std::size_t k = 0; k < profile.size(); ++k) {
        const bool point = profile[k].x == 0.0, below_point = k > 0 && profile[k - 1].x == 0.0;
        const std::uint32_t ring = count(mesh);
        for (std::uint32_t i = 0; i < (point ? 1 : segments); ++i) {
            const glm::dvec2 direction = on_circle(i, segments);
            mesh.vertices.emplace_back(profile[k].x * direction.x, profile[k].y,
                                       -profile[k].x * direction.y);
        }
        for (std::uint32_t i = 0; k > 0 && i < segments; ++i) {
            const std::uint32_t j = (i + 1) % segments;
            if (point && below_point) continue;
            if (below_point)
                mesh.faces.push_back({below, ring + j, ring + i});
            else if (point)
                mesh.faces.push_back({below + i, below + j, ring});
            else
                add_quad(mesh, below + i, below + j, ring + j, ring + i);
        }
        below = ring;
    }
    return mesh;
}

TriangleMesh tube(std::span<const TubePoint> path, std::uint32_t sides, bool capped) {
    TriangleMesh mesh;
    Double3 u{0.0};
    for (std::size_t k = 0; k < path.size(); ++k) {
        const Double3 along = glm::normalize(path[std::min(k + 1, path.size() - 1)].centre -
                                             path[k > 0 ? k - 1 : 0].centre);
        if (k == 0) {
            const Double3 away = std::abs(along.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0};
            u = glm::normalize(glm::cross(along, away));
        } else {  // carried along the path without twisting
            u = glm::normalize(u - along * glm::dot(u, along));
        }
        const Double3 v = glm::cross(along, u);
        const std::uint32_t ring = count(mesh);
        for (std::uint32_t i = 0; i < sides; ++i) {
            const glm::dvec2 direction = on_circle(i, sides);
            mesh.vertices.emplace_back(path[k].centre +
                                       path[k].radius * (direction.x * u + direction.y * v));
        }
        for (std::uint32_t i = 0; k > 0 && i < sides; ++i) {
            const std::uint32_t j = (i + 1) % sides;
            add_quad(mesh, ring - sides + i, ring - sides + j, ring + j, ring + i);
        }
    }
    if (capped) {
        const std::uint32_t top = count(mesh) - sides;
        for (std::uint32_t i = 2; i < sides; ++i) {
            mesh.faces.push_back({0, i, i - 1});
            mesh.faces.push_back({top, top + i - 1, top + i});
        }
    }
    return mesh;
}

TriangleMesh tube(const TubePoint& a, const TubePoint& b, std::uint32_t sides, bool capped) {
    const TubePoint path[] = {a, b};
    return tube(path, sides, capped);
}

std::vector<glm::dvec2> smooth_curve(std::span<const glm::dvec2> points, std::uint32_t steps) {
    std::vector<glm::dvec2> curve{points.front()};
    for (std::size_t k = 1; k < points.size(); ++k) {
        const glm::dvec2 p1 = points[k - 1], p2 = points[k];
        const glm::dvec2 p0 = k >= 2 ? points[k - 2] : p1,
                         p3 = k + 1 < points.size() ? points[k + 1] : p2;
        for (std::uint32_t step = 1; step < steps; ++step) {
            const double t = double(step) / steps;
            const glm::dvec2 bend = (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * t +
                                    (3.0 * p1 - p0 - 3.0 * p2 + p3) * (t * t);
            curve.push_back(p1 + 0.5 * t * (p2 - p0 + bend));
        }
        curve.push_back(p2);
    }
    return curve;
}

TriangleMesh teapot(std::uint32_t detail) {
    const std::uint32_t n = detail, segments = 4 * n;
    TriangleMesh mesh;
    // Body: 3 curved pieces between the axis and the rim, then the lid in 2 and its knob in 2.
    const glm::dvec2 body[] = {{0.085, 0.0}, {0.130, 0.060}, {0.118, 0.130}, {0.070, 0.165}};
    const glm::dvec2 lid[] = {{0.064, 0.165}, {0.045, 0.182}, {0.016, 0.190}};
    const glm::dvec2 knob[] = {{0.012, 0.196}, {0.020, 0.208}, {0.0, 0.220}};
    std::vector<glm::dvec2> profile{{0.0, 0.0}};
    for (const std::span<const glm::dvec2> part :
         {std::span<const glm::dvec2>(body), {lid}, {knob}})
        for (const glm::dvec2& point : smooth_curve(part, n)) profile.push_back(point);
    mesh.append(lathe(profile, segments));

    const auto bent_tube = [&](std::span<const glm::dvec2> path, double first_radius,
                               double last_radius) {
        std::vector<TubePoint> points;
        const std::vector<glm::dvec2> curve = smooth_curve(path, n);
        for (std::size_t i = 0; i < curve.size(); ++i) {
            const double t = double(i) / double(curve.size() - 1);
            points.push_back(
                {{curve[i].x, curve[i].y, 0.0}, first_radius + (last_radius - first_radius) * t});
        }
        mesh.append(tube(points, 2 * n + 2));
    };
    const glm::dvec2 spout[] = {{0.100, 0.055}, {0.160, 0.075}, {0.178, 0.125}, {0.215, 0.158}};
    bent_tube(spout, 0.032, 0.013);
    const glm::dvec2 handle[] = {
        {-0.100, 0.140}, {-0.165, 0.150}, {-0.190, 0.105}, {-0.165, 0.060}, {-0.110, 0.045}};
    bent_tube(handle, 0.012, 0.010);
    return mesh;
}

TriangleMesh moved(TriangleMesh mesh, const Double3& by) {
    return transformed(std::move(mesh), glm::dmat3(1.0), by);
}

TriangleMesh transformed(TriangleMesh mesh, const glm::dmat3& matrix, const Double3& by) {
    for (Point3& vertex : mesh.vertices) vertex = Point3(matrix * Double3(vertex) + by);
    return mesh;
}

glm::dmat3 rotation(const Double3& axis, double degrees) {
    const double angle = degrees * pi / 180.0, c = std::cos(angle), s = std::sin(angle);
    const Double3 a = axis;
    return {
        {c + a.x * a.x * (1 - c), a.y * a.x * (1 - c) + a.z * s, a.z * a.x * (1 - c) - a.y * s},
        {a.x * a.y * (1 - c) - a.z * s, c + a.y * a.y * (1 - c), a.z * a.y * (1 - c) + a.x * s},
        {a.x * a.z * (1 - c) + a.y * s, a.y * a.z * (1 - c) - a.x * s, c + a.z * a.z * (1 - c)}};
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
    for (auto& face : mesh.faces) std::swap(face[1], face[2]);
    return mesh;
}

void add(Scene& scene, const TriangleMesh& mesh, const Color& color) {
    scene.mesh.append(mesh);
    scene.colors.resize(scene.mesh.faces.size(), color);
}

void add_light(Scene& scene, const Double3& position, const Double3& lit, const Color& brightness) {
    const Double3 way = position - lit;
    scene.lights.push_back(
        {Point3(position), brightness * static_cast<float>(pi * glm::dot(way, way))});
}

void add_eye_light(Scene& scene, const Color& brightness) {
    add_light(scene, Double3(scene.camera.eye), Double3(scene.camera.target), brightness);
}

Color srgb(std::uint32_t rgb) {
    Color color;
    for (int channel = 0; channel < 3; ++channel) {
        const double c = ((rgb >> (16 - 8 * channel)) & 0xFF) / 255.0;  // IEC 61966-2-1
        color[channel] =
            static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return color;
}

}  // namespace space
