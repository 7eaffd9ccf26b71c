// What a BSP tree is good for, against exact answers: painter's order and the z-buffer, inside and
// outside.
#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "common/program/report.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch03/cgal_fragments.hpp"
#include "tests/ch03/tiling_scenes.hpp"
#include "tests/oracle/exact.hpp"

#include <fmt/format.h>

#include <map>

namespace space {
namespace {

constexpr int width = sized(48, 16), height = sized(36, 12), points_each = sized(1'500, 30);

std::vector<TestScene> painted_scenes() {
    return {{"random", scenes::soup(40, 0.6f, 1)},
            {"coplanar", scenes::coplanar(6, 3)},
            {"whole numbers", scenes::whole_numbers(50, 5, 4)},
            {"touching", scenes::touching()},
            {"needles", scenes::needles(40, 5)},
            {"torus", scenes::torus(16, 8)}};
}

Aabb box_of(const std::vector<Triangle>& triangles) {
    Aabb box;
    for (const Triangle& t : triangles) box.extend(bounds(t));
    return box;
}

/// Outside, inside the box, at vertices, on planes of the triangles, far beyond a triangle in its
/// plane.
std::vector<Point3> eyes(const std::vector<Triangle>& triangles, std::uint64_t seed) {
    Pcg32 random(seed);
    const Aabb box = box_of(triangles);
    const auto in_box = [&](float low, float high) {
        return box.min + random_point(random, low, high) * box.extent();
    };
    const auto any = [&]() -> const Triangle& {
        return triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
    };
    std::vector<Point3> result;
    for (int i = 0; i < 3; ++i) {
        result.push_back(in_box(-1.0f, 2.0f));
        result.push_back(in_box(0.0f, 1.0f));
        const Triangle& t = any();
        result.push_back(t.a);
        result.push_back(0.5f * (t.b + t.c));
        result.push_back(t.a + 2.0f * (t.a - t.b));  // exactly in the plane for whole numbers
    }
    return result;
}

/// What the last painted fragment is in the ray's way, by exact arithmetic.
std::optional<std::uint32_t> last_painted(const BspTree<3>& tree, const CgalFragments& fragments,
                                          const std::vector<std::uint32_t>& order, const Ray& ray) {
    for (auto f = order.rbegin(); f != order.rend(); ++f) {
        const std::uint32_t polygon = tree.fragments[*f].polygon;
        const Triangle& p = tree.polygons[polygon];
        if (decide(ray, p) != Place::miss && fragments.meets(ray, *f)) return polygon;
    }
    return std::nullopt;
}

/// The ray lies in the plane of a node that the eye lies in, exactly: what it passes on both sides
/// of that plane has no order.
bool within_a_plane(const BspTree<3>& tree, const Ray& ray) {
    // A direction of floats and an origin of floats: a second point of the ray is their exact sum.
    for (const auto& node : tree.nodes)
        if (tree.side_of(ray.origin, node) == 0 &&
            cgal_side(tree.planes[node.plane].through,
                      Double3(ray.origin) + Double3(ray.direction)) == 0)
            return true;
    return false;
}

std::vector<std::uint32_t> painters_order(const BspTree<3>& tree, const Point3& eye) {
    std::vector<std::uint32_t> order;
    tree.back_to_front(eye, [&](const Fragment<3>& f) {
        order.push_back(static_cast<std::uint32_t>(&f - tree.fragments.data()));
    });
    return order;
}

}  // namespace

TEST_CASE(
    "painter's order: the last fragment painted in a pixel is of the triangle exactly nearest "
    "there, from any eye") {
    std::uint64_t pixels = 0, covered = 0, ties = 0, within = 0, wrong = 0;
    for (const TestScene& scene : painted_scenes()) {
        const ExactOracle oracle = ExactOracle::build(scene.triangles);
        const BspTree<3> tree = BspBuilder<3>::build(scene.triangles);
        const CgalFragments fragments(view(tree, Grade::exact));
        const Point3 target = box_of(scene.triangles).centroid();
        for (const Point3& eye : eyes(scene.triangles, 1)) {
            const std::vector<std::uint32_t> order = painters_order(tree, eye);
            REQUIRE(order.size() == tree.fragments.size());
            Camera camera{.eye = eye,
                          .target = target == eye ? target + Point3(1, 0, 0) : target,
                          .field_of_view = 70};
            camera.up = std::abs(camera.target.x - eye.x) + std::abs(camera.target.z - eye.z) > 0
                            ? Vector3(0, 1, 0)
                            : Vector3(1, 0, 0);
            const CameraFrame frame(camera);
            Pcg32 random(2);
            for (int i = 0; i < width * height / 8; ++i) {
                const double x = random.below(width) + 0.5, y = random.below(height) + 0.5;
                Ray ray = camera_ray(camera, frame, x, y, width, height);
                if (i % 5 == 0) {  // exactly at a vertex or in the direction of an edge
                    const Triangle& t = scene.triangles[random.below(
                        static_cast<std::uint32_t>(scene.triangles.size()))];
                    ray.direction = i % 10 ? t.a - eye : t.b - t.a;
                    if (ray.direction == Vector3(0.0f)) continue;
                }
                ray.tmin = 0x1p-100f;  // not the surface that the eye is on
                const std::vector<ExactHit> nearest = oracle.closest(ray);
                const auto painted = last_painted(tree, fragments, order, ray);
                ++pixels;
                covered += !nearest.empty();
                ties += nearest.size() > 1;
                const bool right = nearest.empty()
                                       ? !painted
                                       : painted && std::any_of(nearest.begin(), nearest.end(),
                                                                [&](const ExactHit& hit) {
                                                                    return hit.triangle == *painted;
                                                                });
                if (right) continue;
                within_a_plane(tree, ray) && painted ? ++within : ++wrong;
            }
        }
    }
    fmt::print(
        "  painter: {} rays, {} hit, {} of them several triangles at once; wrong {}, without an "
        "order {}\n",
        with_commas(pixels), with_commas(covered), with_commas(ties), wrong, within);
    CHECK(wrong == 0);
    CHECK(within < ties);
    CHECK(covered > pixels / 4);
    CHECK(ties > 0);
}

TEST_CASE("a fragment is painted before what hides it in the plane, too") {
    // In the plane fragments are seen edge-on from everywhere: rays against segments, by rational
    // arithmetic in the painter's order of the tree of A .. G, from a grid of eyes.
    const std::vector<Segment> segments = heinonen_segments();
    const BspTree<2> tree = BspBuilder<2>::build(segments);
    int compared = 0;
    for (int ex = 0; ex <= 16; ++ex)
        for (int ey = 0; ey <= 16; ++ey) {
            const Point2 eye(ex, ey);
            std::vector<const Fragment<2>*> order;
            tree.back_to_front(eye, [&](const Fragment<2>& f) { order.push_back(&f); });
            CHECK(order.size() == tree.fragments.size());
            for (int k = 0; k < 48; ++k) {
                const Double2 d(std::cos(0.1309 * k + 0.01), std::sin(0.1309 * k + 0.01));
                const auto at = [&](const Double2& a, const Double2& b) -> std::optional<double> {
                    const Double2 from = a - Double2(eye), along = b - a;
                    const double det = d.x * along.y - d.y * along.x;
                    const double t = (from.x * along.y - from.y * along.x) / det,
                                 s = (from.x * d.y - from.y * d.x) / det;
                    return t > 1e-9 && s >= 0 && s <= 1 ? std::optional(t) : std::nullopt;
                };
                std::optional<std::uint32_t> nearest, painted;
                double best = 1e9;
                for (std::uint32_t i = 0; i < segments.size(); ++i)
                    if (const auto t = at(Double2(segments[i][0]), Double2(segments[i][1]));
                        t && *t < best) {
                        best = *t;
                        nearest = i;
                    }
                for (const Fragment<2>* f : order)
                    if (at(f->corners[0].at, f->corners[1].at)) painted = f->polygon;
                CHECK(painted == nearest);
                compared += nearest.has_value();
            }
        }
    CHECK(compared > 3000);
}

namespace {

/// The painter's picture: fragment over fragment, in double, no depth compared. Which polygon each
/// pixel shows.
DepthBuffer painted_picture(const BspTree<3>& tree, const Camera& camera, int w, int h) {
    const CameraFrame frame(camera);
    DepthBuffer picture(w, h);
    tree.back_to_front(camera.eye, [&](const Fragment<3>& fragment) {
        const Triangle& p = tree.polygons[fragment.polygon];
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                const Ray ray = camera_ray(camera, frame, x + 0.5, y + 0.5, w, h);
                bool left = false, right = false;
                for (std::size_t i = 0; i < fragment.corners.size() && !(left && right); ++i) {
                    const Double3 a = fragment.corners[i].at - Double3(ray.origin);
                    const Double3 b = fragment.corners[(i + 1) % fragment.corners.size()].at -
                                      Double3(ray.origin);
                    const double side = glm::dot(glm::cross(a, b), Double3(ray.direction));
                    left = left || side > 0;
                    right = right || side < 0;
                }
                if (left == right) continue;
                const SplitPlane<3> plane(p);
                const double t = -plane.distance(Double3(ray.origin)) /
                                 glm::dot(plane.normal, Double3(ray.direction));
                if (t > 0.0) picture.at(x, y) = {static_cast<float>(t), fragment.polygon};
            }
    });
    return picture;
}

struct Differences {
    std::uint64_t pixels = 0, covered = 0, differ = 0, near_edge = 0, same_depth = 0,
                  unexplained = 0;
};

/// A pixel may differ where its centre lies within the rasteriser's coverage_distance of the
/// picture of a fragment's edge, or where the exact depths of both triangles are the same to a few
/// floats.
Differences compare_pictures(const BspTree<3>& tree, const Camera& camera,
                             const DepthBuffer& painted, const DepthBuffer& buffer) {
    const CameraFrame frame(camera);
    const double limit = coverage_distance({camera, buffer.width, buffer.height});
    const double near = near_fraction * glm::distance(Double3(camera.eye), Double3(camera.target));
    Differences result;
    for (int y = 0; y < buffer.height; ++y)
        for (int x = 0; x < buffer.width; ++x) {
            const Hit &one = painted.at(x, y), &other = buffer.at(x, y);
            ++result.pixels;
            result.covered += other.t < infinity;
            if ((one.t == infinity && other.t == infinity) ||
                (one.triangle == other.triangle && one.t < infinity && other.t < infinity))
                continue;
            ++result.differ;
            bool near_edge = false;
            for (const Fragment<3>& f : tree.fragments) {
                if (!(one.t < infinity && f.polygon == one.triangle) &&
                    !(other.t < infinity && f.polygon == other.triangle))
                    continue;
                for (std::size_t i = 0; i < f.corners.size() && !near_edge; ++i) {
                    Double3 a = world_to_camera(camera, frame, f.corners[i].at);
                    Double3 b =
                        world_to_camera(camera, frame, f.corners[(i + 1) % f.corners.size()].at);
                    if (depth(a) < near && depth(b) < near) continue;
                    if (depth(a) < near) std::swap(a, b);
                    if (depth(b) < near)
                        b = a + (b - a) * ((depth(a) - near) / (depth(a) - depth(b)));
                    const glm::dvec2 p = camera_to_pixel(frame, a, buffer.width, buffer.height),
                                     q = camera_to_pixel(frame, b, buffer.width, buffer.height);
                    near_edge = distance_to_outline({x + 0.5, y + 0.5}, {p, q}) <= limit;
                }
            }
            const Ray ray =
                camera_ray(camera, frame, x + 0.5, y + 0.5, buffer.width, buffer.height);
            const auto exact_depth = [&](const Hit& hit) {
                const Triangle& p = tree.polygons[hit.triangle];
                return hit.t < infinity ? crossing(ray, p).value().t : double{infinity};
            };
            const double depth_one = exact_depth(one), depth_other = exact_depth(other);
            if (near_edge)
                ++result.near_edge;
            else if (std::abs(depth_one - depth_other) <=
                     same_depth_tolerance * std::min(depth_one, depth_other))
                ++result.same_depth;
            else
                ++result.unexplained;
        }
    return result;
}

}  // namespace

TEST_CASE("the painter's picture is the z-buffer's, but for pixels at edges and of equal depth") {
    Differences all;
    for (const TestScene& scene : painted_scenes()) {
        const BspTree<3> tree = BspBuilder<3>::build(scene.triangles);
        const Aabb box = box_of(scene.triangles);
        Pcg32 random(6);
        for (int view_number = 0; view_number < 3; ++view_number) {
            const Camera camera{
                .eye = box.min + random_point(random, view_number == 2 ? 0.0f : 1.2f,
                                              view_number == 2 ? 1.0f : 2.2f) *
                                     box.extent(),
                .target = box.centroid(),
                .field_of_view = 60};
            Rasteriser rasteriser({camera, 2 * width, 2 * height});
            for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
                rasteriser.draw(scene.triangles[i], i);
            const Differences d =
                compare_pictures(tree, camera, painted_picture(tree, camera, 2 * width, 2 * height),
                                 rasteriser.buffer());
            INFO(scene.name << ", view " << view_number << ": " << d.unexplained << " of "
                            << d.differ << " unexplained");
            CHECK(d.unexplained == 0);
            all.pixels += d.pixels;
            all.covered += d.covered;
            all.differ += d.differ;
            all.near_edge += d.near_edge;
            all.same_depth += d.same_depth;
        }
    }
    fmt::print("  pictures: {} pixels, {} covered, {} differ: {} at edges, {} of equal depth\n",
               with_commas(all.pixels), with_commas(all.covered), all.differ, all.near_edge,
               all.same_depth);
    CHECK(all.covered > all.pixels / 5);
    CHECK(all.near_edge < all.covered / 100);
    CHECK(all.near_edge > 0);  // the comparison can see a difference at all
}

TEST_CASE("without cuts or in the wrong order the painter's picture is wrong") {
    // Three long triangles, each over the next: no order of whole triangles is right.
    const std::vector<Triangle> cycle{{{-3, -1, 0}, {3, -1, 1}, {3, -0.5f, 1}},
                                      {{1, -3, 0}, {1, 3, 1}, {0.5f, 3, 1}},
                                      {{2, 2, 0}, {-2, -2.5f, 1}, {-2.2f, -2, 1}}};
    const Camera camera{.eye = {0, 0, 9}, .target = {0, 0, 0}, .field_of_view = 45};
    Rasteriser rasteriser({camera, 96, 72});
    for (std::uint32_t i = 0; i < 3; ++i) rasteriser.draw(cycle[i], i);
    const auto polygons = cycle;
    const BspTree<3> right = BspBuilder<3>::build(polygons),
                     shared = BspBuilder<3>::build(polygons,
                                                   {.straddlers = BspConfig::Straddlers::share});
    CHECK(right.fragments.size() > 3);
    CHECK(
        compare_pictures(right, camera, painted_picture(right, camera, 96, 72), rasteriser.buffer())
            .unexplained == 0);
    CHECK(compare_pictures(right, camera, painted_picture(shared, camera, 96, 72),
                           rasteriser.buffer())
              .unexplained > 0);
}

// ---- inside and outside
// -------------------------------------------------------------------------------------------

namespace {

/// By parity, in exact arithmetic: along a ray that meets only the inner points of triangles. Both
/// ways must agree.
std::optional<Location> exact_cell(const ExactOracle& oracle, const Point3& p, Pcg32& random) {
    for (const Triangle& t : oracle.triangles()) {
        Aabb box = bounds(t);
        if (box.contains(p) && cgal_has_on(t, p)) return Location::boundary;
    }
    for (int attempt = 0; attempt < 20; ++attempt) {
        const Vector3 direction = random_point(random, -1.0f, 1.0f);
        bool clean = true;
        std::size_t ahead = 0, behind = 0;
        for (const ExactHit& hit :
             oracle.hits({.origin = p, .direction = direction, .tmin = -infinity})) {
            clean = clean && hit.place == Place::interior && hit.t != 0.0f;
            ++(hit.t > 0 ? ahead : behind);
        }
        if (!clean) continue;
        if (ahead % 2 != behind % 2) return std::nullopt;  // the mesh is not closed
        return ahead % 2 ? Location::inside : Location::outside;
    }
    return std::nullopt;
}

}  // namespace

TEST_CASE(
    "points are inside, outside or on the boundary of closed meshes as exact arithmetic says") {
    std::vector<Triangle> boxes;
    scenes::add_box(boxes, {0, 0, 0}, {4, 4, 1});
    scenes::add_box(boxes, {1, 1, 1.5f}, {2, 3, 4});
    scenes::add_box(boxes, {5, 0, 0}, {6, 1, 6});
    const std::vector<TestScene> meshes{{"icosphere", icosphere(4).triangles()},
                                        {"torus", scenes::torus(20, 10)},
                                        {"bumpy ball", scenes::ball(2)},
                                        {"boxes", boxes}};
    std::map<Location, std::uint64_t> seen;
    for (const TestScene& mesh : meshes)
        for (const BspConfig::SplitterChoice choice :
             {BspConfig::SplitterChoice::weighted, BspConfig::SplitterChoice::free,
              BspConfig::SplitterChoice::first}) {
            const ExactOracle oracle = ExactOracle::build(mesh.triangles);
            const BspTree<3> tree = BspBuilder<3>::build(mesh.triangles, {.splitter = choice});
            const Aabb box = box_of(mesh.triangles);
            Pcg32 random(3);
            std::uint64_t wrong = 0, undecided = 0;
            for (int i = 0; i < points_each / 3; ++i) {
                const Triangle& t =
                    mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
                Point3 p = box.min + random_point(random, -0.2f, 1.2f) * box.extent();
                if (i % 6 == 1) p = t.a;                 // on the surface
                if (i % 6 == 2) p = 0.5f * (t.a + t.b);  // on an edge, or nearly
                if (i % 6 == 3) {                        // nearly on a face
                    p = t.a + random.uniform() * (t.b - t.a);
                    p += random.uniform() * 0.3f * (t.c - t.a);
                }
                if (i % 6 == 4) p = t.a + 2.0f * (t.a - t.b);     // in a face's plane, beyond it
                if (i % 6 == 5) p = glm::floor(p * 2.0f) * 0.5f;  // on the planes of boxes
                const auto expected = exact_cell(oracle, p, random);
                if (!expected) {
                    ++undecided;
                    continue;
                }
                ++seen[*expected];
                wrong += tree.locate(p) != *expected;
            }
            INFO(mesh.name << ", choice " << static_cast<int>(choice));
            CHECK(wrong == 0);
            CHECK(undecided == 0);
        }
    fmt::print("  located: {} outside, {} inside, {} on the boundary\n", seen[Location::outside],
               seen[Location::inside], seen[Location::boundary]);
    for (const Location cell : {Location::outside, Location::inside, Location::boundary})
        CHECK(seen[cell] > 20);
}

TEST_CASE("a point on a plane of the tree but off all polygons is not on the boundary") {
    std::vector<Triangle> boxes;
    scenes::add_box(boxes, {0, 0, 0}, {1, 1, 1});
    scenes::add_box(boxes, {2, 0, 0}, {3, 1, 2});
    const BspTree<3> tree = BspBuilder<3>::build(boxes);
    CHECK(tree.locate({1.5f, 1, 1}) == Location::outside);  // on planes of both
    CHECK(tree.locate({1.5f, 0.5f, 1}) == Location::outside);
    CHECK(tree.locate({2.5f, 0.5f, 1}) == Location::inside);  // on the plane of the first one's lid
    CHECK(tree.locate({1, 0.5f, 1}) == Location::boundary);   // on its edge
    CHECK(tree.locate({1, 1, 1}) == Location::boundary);      // on its corner
    CHECK(tree.locate({0.5f, 0.5f, 1}) == Location::boundary);
    CHECK(tree.locate({0.5f, 0.5f, std::nextafter(1.0f, 0.0f)}) == Location::inside);
    CHECK(tree.locate({0.5f, 0.5f, std::nextafter(1.0f, 2.0f)}) == Location::outside);
}

TEST_CASE("in the plane: the inside of a polygon whose segments have it on their right") {
    // A star with a notch; fronts are on the left, so clockwise.
    const std::vector<Point2> star{{0, 0}, {1, 4}, {3, 5}, {2, 2}, {6, 3}, {5, 0}, {3, 1}};
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < star.size(); ++i)
        segments.push_back({star[i], star[(i + 1) % star.size()]});
    for (const BspConfig::SplitterChoice choice :
         {BspConfig::SplitterChoice::first, BspConfig::SplitterChoice::weighted}) {
        const BspTree<2> tree = BspBuilder<2>::build(segments, {.splitter = choice});
        int counts[3] = {};
        for (int i = -8; i <= 56; ++i)
            for (int j = -8; j <= 48; ++j) {
                const Point2 p(static_cast<float>(i) / 8, static_cast<float>(j) / 8);
                bool on = false;
                int crossings = 0;
                for (const Segment& s : segments) {
                    const int side = cgal_side(s, Double2(p));
                    const Point2 low = glm::min(s[0], s[1]), high = glm::max(s[0], s[1]);
                    on = on || (side == 0 && p.x >= low.x && p.x <= high.x && p.y >= low.y &&
                                p.y <= high.y);
                    if ((s[0].y <= p.y) != (s[1].y <= p.y))
                        crossings += (s[1].y > s[0].y) == (side > 0);
                }
                const Location expected = on              ? Location::boundary
                                          : crossings % 2 ? Location::inside
                                                          : Location::outside;
                CHECK(tree.locate(p) == expected);
                ++counts[static_cast<int>(expected)];
            }
        for (const int count : counts) CHECK(count > 20);
    }
}

}  // namespace space
