#include "chapters/ch01_naive_ray_tracing/figures/figures.hpp"

#include "chapters/ch01_naive_ray_tracing/coordinate_systems.hpp"
#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "chapters/ch01_naive_ray_tracing/measured/measurements.hpp"
#include "chapters/ch01_naive_ray_tracing/measured/outcome.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/measure.hpp"
#include "common/program/file.hpp"
#include "common/program/report.hpp"
#include "common/program/svg.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace space::ch01 {
namespace {

/// How a drawing shows three dimensions: without perspective, from the side `yaw` and from above
/// `pitch`, angles given by a Pythagorean triple, so that no cosine differs between libraries.
struct View {
    glm::dvec2 origin;  ///< where (0, 0, 0) is drawn
    double scale;       ///< drawing units per unit
    double yaw_cos, yaw_sin, pitch_cos, pitch_sin;

    Point2 operator()(const Double3& p) const {
        const double across = yaw_cos * p.x - yaw_sin * p.z, along = yaw_sin * p.x + yaw_cos * p.z;
        return Point2(origin + scale * glm::dvec2(across, pitch_sin * along - pitch_cos * p.y));
    }
    /// Whether the drawing shows the side that the normal points to.
    bool faces(const Double3& n) const {
        return pitch_cos * (yaw_sin * n.x + yaw_cos * n.z) + pitch_sin * n.y > 0.0;
    }
    std::vector<Point2> outline(const std::vector<Double3>& points) const {
        std::vector<Point2> drawn;
        for (const Double3& p : points) drawn.push_back((*this)(p));
        return drawn;
    }
};

void write(const Options& options, const char* id, const Svg& svg) {
    write_file(options.out / (std::string(id) + ".svg"), svg.document());
}

Point2 moved(const Point2& p, double x, double y) {
    return {p.x + static_cast<float>(x), p.y + static_cast<float>(y)};
}

/// A number in a label: a true minus sign, no negative zero.
std::string shown(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find_first_not_of("-0.") == text.npos && text.front() == '-') text.erase(0, 1);
    return text.front() == '-' ? "\u2212" + text.substr(1) : text;
}

std::string shown(const Double3& p) {
    return fmt::format("({}, {}, {})", shown(p.x, 1), shown(p.y, 1), shown(p.z, 1));
}

// -------------------------------------------------------------------------------------------------
// 1.1 The three coordinate systems

/// A house with a gable roof: polygons, counter-clockwise seen from outside. The local origin is a
/// corner of its front.
const Double3 house_tip{0.5, 1.1, 0.0};
std::vector<std::vector<Double3>> house() {
    const std::array<glm::dvec2, 5> gable{
        {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.65}, {0.5, 1.1}, {0.0, 0.65}}};
    std::vector<std::vector<Double3>> faces(2);
    for (std::size_t i = 0; i < gable.size(); ++i) {
        const glm::dvec2 p = gable[i], q = gable[(i + 1) % gable.size()];
        faces[0].emplace_back(p.x, p.y, 0.0);
        faces[1].insert(faces[1].begin(), Double3(p.x, p.y, -1.2));
        faces.push_back({{p.x, p.y, 0.0}, {p.x, p.y, -1.2}, {q.x, q.y, -1.2}, {q.x, q.y, 0.0}});
    }
    return faces;
}

void draw_house(Svg& svg, const View& view, const Map& map) {
    for (std::vector<Double3> face : house()) {
        for (Double3& p : face) p = map_point(map, p);
        const Double3 n = glm::cross(face[1] - face[0], face[2] - face[0]);
        if (view.faces(n))
            svg.polygon(view.outline(face),
                        {.fill = Ink::sky,
                         .opacity = 0.25 + 0.35 * glm::normalize(n).y * glm::normalize(n).y});
    }
    svg.circle(view(map_point(map, house_tip)), 5, {.stroke = {}, .fill = Ink::ink});
}

/// The three axes of a system, given by its map to what the view draws; names stand beyond the
/// tips.
void draw_axes(Svg& svg, const View& view, const Map& map, double length, Ink ink) {
    const Point2 origin = view(map_point(map, Double3(0.0)));
    const std::array<const char*, 3> names{"*x*", "*y*", "*z*"};
    for (int axis = 0; axis < 3; ++axis) {
        Double3 unit(0.0);
        unit[axis] = 1.0;
        const Double3 direction = length * glm::normalize(map_vector(map, unit));
        const Point2 tip = view(map_point(map, Double3(0.0)) + direction);
        svg.line(origin, tip, {.stroke = ink, .arrow = true});
        const Vector2 beyond = tip + 13.0f * glm::normalize(tip - origin);
        svg.text(moved(beyond, 0, 5), names[static_cast<std::size_t>(axis)],
                 {.ink = ink, .size = 18, .halo = true});
    }
}

/// Eye and image plane: four lines to the corners of what the camera sees at this distance.
void draw_camera(Svg& svg, const View& view, const Map& camera_to_drawn, double tan_half_fov,
                 double distance) {
    const double y = tan_half_fov * distance, x = y * 4 / 3;
    std::vector<Double3> corners{
        {-x, -y, -distance}, {x, -y, -distance}, {x, y, -distance}, {-x, y, -distance}};
    const Point2 eye = view(map_point(camera_to_drawn, Double3(0.0)));
    for (Double3& corner : corners) {
        corner = map_point(camera_to_drawn, corner);
        svg.line(eye, view(corner), {.stroke = Ink::quiet});
    }
    svg.polygon(view.outline(corners),
                {.stroke = Ink::quiet, .fill = Ink::yellow, .opacity = 0.25});
    svg.circle(eye, 5, {.stroke = {}, .fill = Ink::vermillion});
}

void fig_01_01(const Options& options) {
    Svg svg("fig_01_01", "One house in its local coordinates, in the world's, and in the camera's",
            640, 570);
    const Camera camera{
        .eye = {-2.2f, 1.5f, 1.6f}, .target = {1.4f, 0.4f, -1.2f}, .field_of_view = 40.0f};
    const CameraFrame frame(camera);
    const Map from_camera = camera_to_world(camera), to_camera = glm::inverse(from_camera);
    const Map placed =
        local_to_world({.translation = {1.1, 0.0, -0.4}, .angle = -0.3, .scale = Double3(1.3)});
    const Double3 tip = map_point(placed, house_tip);

    const View local{{70, 204}, 86, 12.0 / 13, 5.0 / 13, 12.0 / 13, 5.0 / 13};
    const View world{{290, 440}, 68, 12.0 / 13, 5.0 / 13, 15.0 / 17, 8.0 / 17};
    const View seen{{412, 204}, 36, 5.0 / 13, 12.0 / 13, 12.0 / 13, 5.0 / 13};

    svg.begin_group("local");
    draw_house(svg, local, Map(1.0));
    draw_axes(svg, local, Map(1.0), 1.45, Ink::blue);
    svg.end_group();

    svg.begin_group("world");
    for (int i = -3; i <= 4; ++i)
        svg.line(world(Double3(i, 0, -2)), world(Double3(i, 0, 2)), {.stroke = Ink::faint});
    for (int i = -2; i <= 2; ++i)
        svg.line(world(Double3(-3, 0, i)), world(Double3(4, 0, i)), {.stroke = Ink::faint});
    draw_axes(svg, world, Map(1.0), 1.2, Ink::ink);
    draw_house(svg, world, placed);
    draw_axes(svg, world, placed, 1.8, Ink::blue);
    draw_camera(svg, world, from_camera, frame.tan_half_fov, 1.0);
    draw_axes(svg, world, from_camera, 0.9, Ink::vermillion);
    svg.end_group();

    svg.begin_group("camera");
    draw_house(svg, seen, to_camera * placed);
    draw_camera(svg, seen, Map(1.0), frame.tan_half_fov, 1.0);
    draw_axes(svg, seen, Map(1.0), 1.2, Ink::vermillion);
    svg.end_group();

    const auto heading = [&](Point2 at, const char* name, Ink ink, const Double3& p) {
        svg.text(at, name, {.ink = ink, .size = 20, .bold = true});
        svg.text(moved(at, 0, 26), "*P* = " + shown(p), {.size = 18});
    };
    heading({110, 28}, "local", Ink::blue, house_tip);
    heading({520, 28}, "camera", Ink::vermillion, world_to_camera(camera, frame, tip));
    heading({130, 524}, "world", Ink::ink, tip);
    svg.line({110, 250}, {146, 306}, {.stroke = Ink::quiet, .arrow = true}, "local-to-world");
    svg.text({144, 276}, "*M* = *T R S*", {.anchor = Anchor::start, .size = 18, .halo = true});
    svg.line({500, 306}, {530, 250}, {.stroke = Ink::quiet, .arrow = true}, "world-to-camera");
    svg.text({532, 290}, "*V*", {.anchor = Anchor::start, .size = 18, .halo = true});
    write(options, "fig_01_01", svg);
}

// -------------------------------------------------------------------------------------------------
// 1.2 Winding and normal

void fig_01_02(const Options& options) {
    Svg svg(
        "fig_01_02",
        "The same triangle with its vertices in two orders: the normal points to opposite sides",
        640, 376);
    const auto draw = [&](double x, const Triangle& triangle, Ink ink, const char* first,
                          const char* second, std::string id) {
        const View view{{x, 170}, 118, 12.0 / 13, 5.0 / 13, 0.8, 0.6};
        const std::array<Double3, 3> corners{Double3(triangle.a), Double3(triangle.b),
                                             Double3(triangle.c)};
        const Double3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        const Double3 tip = middle + 1.2 * glm::normalize(normal(triangle));
        const bool front = view.faces(normal(triangle));

        svg.begin_group(id);
        const auto draw_normal = [&] {
            svg.line(view(middle), view(tip), {.stroke = ink, .arrow = true});
            svg.text(moved(view(tip), 16, front ? 6 : 0), "*n*",
                     {.anchor = Anchor::start, .ink = ink, .size = 20});
        };
        if (!front) draw_normal();
        svg.polygon(view.outline({corners[0], corners[1], corners[2]}),
                    {.fill = front ? Ink::sky : Ink::orange, .opacity = 0.4});
        // The way round, a little inside the outline.
        for (std::size_t i = 0; i < 3; ++i) {
            const auto inside = [&](const Double3& p) { return middle + 0.62 * (p - middle); };
            const Double3 from = inside(corners[i]), to = inside(corners[(i + 1) % 3]);
            svg.line(view(from + 0.12 * (to - from)), view(to - 0.12 * (to - from)),
                     {.stroke = Ink::ink, .arrow = true});
        }
        if (front) {
            draw_normal();
            svg.circle(view(middle), 4, {.stroke = {}, .fill = ink});
        }
        const std::array<const char*, 3> names{"*a*", "*b*", "*c*"};
        for (std::size_t i = 0; i < 3; ++i) {
            const Point2 p = view(corners[i]), out = p + 20.0f * glm::normalize(p - view(middle));
            svg.text(moved(out, 0, 6), names[i], {.size = 20});
        }
        svg.text({x, 330}, first, {.size = 18, .bold = true});
        svg.text({x, 356}, second, {.size = 18});
        svg.end_group();
    };
    const Point3 a{-1.0f, 0.0f, 0.5f}, b{0.8f, 0.0f, 0.9f}, c{0.4f, 0.0f, -0.9f};
    draw(160, {a, b, c}, Ink::blue, "counter-clockwise", "we see the front side", "front");
    svg.text({320, 30}, "*n* = (*b* \u2212 *a*) \u00d7 (*c* \u2212 *a*)", {.size = 20});
    draw(480, {a, c, b}, Ink::vermillion, "clockwise", "we see the back side", "back");
    write(options, "fig_01_02", svg);
}

// -------------------------------------------------------------------------------------------------
// 1.3 The pixel's ray

void fig_01_03(const Options& options) {
    Svg svg("fig_01_03",
            "The ray from the eye through the centre of a pixel to a triangle, and the axis of t "
            "below it",
            640, 416);
    constexpr int width = 8, height = 6, pixel_x = 5, pixel_y = 2;
    const Camera camera{
        .eye = {0.0f, 0.0f, 0.0f}, .target = {0.0f, 0.0f, -1.0f}, .field_of_view = 60.0f};
    const CameraFrame frame(camera);
    const Ray ray = camera_ray(camera, frame, pixel_x + 0.5, pixel_y + 0.5, width, height);
    const Triangle triangle{{-0.6f, -0.3f, -3.0f}, {1.3f, -0.4f, -2.9f}, {0.6f, 1.0f, -2.8f}};
    const Hit hit = MollerTrumbore::intersect(ray, triangle).value();
    constexpr double t_min = 0.3, t_max = 3.6;

    const View view{{56, 218}, 138, 8.0 / 17, 15.0 / 17, 12.0 / 13, 5.0 / 13};
    const auto on_image = [&](double x, double y) {
        return view(Double3(camera_ray(camera, frame, x, y, width, height).at(1.0f)));
    };
    const auto on_ray = [&](double t) {
        return view(Double3(ray.origin) + t * Double3(ray.direction));
    };

    // From back to front.
    svg.line(on_ray(hit.t), on_ray(t_max),
             {.stroke = Ink::vermillion, .dashed = true, .arrow = true});
    svg.polygon(view.outline({Double3(triangle.a), Double3(triangle.b), Double3(triangle.c)}),
                {.fill = Ink::sky, .opacity = 0.55}, "triangle");
    svg.line(on_ray(1.0), on_ray(hit.t), {.stroke = Ink::vermillion});
    svg.begin_group("image-plane");
    svg.polygon({on_image(0, 0), on_image(width, 0), on_image(width, height), on_image(0, height)},
                {.fill = Ink::paper, .opacity = 0.7});
    svg.polygon({on_image(pixel_x, pixel_y), on_image(pixel_x + 1, pixel_y),
                 on_image(pixel_x + 1, pixel_y + 1), on_image(pixel_x, pixel_y + 1)},
                {.stroke = {}, .fill = Ink::yellow});
    for (int x = 0; x <= width; ++x)
        svg.line(on_image(x, 0), on_image(x, height), {.stroke = Ink::quiet});
    for (int y = 0; y <= height; ++y)
        svg.line(on_image(0, y), on_image(width, y), {.stroke = Ink::quiet});
    svg.end_group();
    svg.line(on_ray(0.0), on_ray(1.0), {.stroke = Ink::vermillion});
    for (const double t : {0.0, 1.0, double{hit.t}})
        svg.circle(on_ray(t), 5, {.stroke = {}, .fill = Ink::vermillion});

    svg.text(moved(on_ray(0), 0, -16), "*O*", {.size = 20});
    svg.text(moved(on_ray(hit.t), 26, 34), "*P* = *O* + *t D*",
             {.anchor = Anchor::start, .size = 20, .halo = true});
    svg.text(moved(on_image(0, 0), 0, -14), fmt::format("{} × {} pixels", width, height), {});
    const std::array<std::pair<Point3, const char*>, 3> names{
        {{triangle.a, "*a*"}, {triangle.b, "*b*"}, {triangle.c, "*c*"}}};
    for (const auto& [p, name] : names)
        svg.text(moved(view(Double3(p)), p.x < 0 ? -14 : 0,
                       p.y > 0   ? -12
                       : p.x < 0 ? 6
                                 : 24),
                 name, {.size = 20});

    // The axis of t: every mark stands below its point on the ray.
    svg.begin_group("t-axis");
    constexpr double axis_y = 370;
    const auto mark = [&](double t, const std::string& label, bool tied) {
        const Point2 p = on_ray(t);
        if (tied) svg.line(moved(p, 0, 8), {p.x, axis_y - 8}, {.stroke = Ink::faint});
        svg.line({p.x, axis_y - 8}, {p.x, axis_y + 8});
        svg.text({p.x, axis_y + 30}, label, {.size = 18});
    };
    svg.polygon({{on_ray(t_min).x, axis_y - 6},
                 {on_ray(t_max).x, axis_y - 6},
                 {on_ray(t_max).x, axis_y + 6},
                 {on_ray(t_min).x, axis_y + 6}},
                {.stroke = {}, .fill = Ink::green, .opacity = 0.45}, "interval");
    svg.line({on_ray(0).x, axis_y}, {620, axis_y}, {.arrow = true});
    mark(0, "0", true);
    mark(t_min, "*t*_{min}", false);
    mark(1, "1", true);
    mark(hit.t, fmt::format("*t* = {}", shown(hit.t, 2)), true);
    mark(t_max, "*t*_{max}", false);
    svg.text({620, axis_y - 14}, "*t*", {.size = 20});
    svg.end_group();
    write(options, "fig_01_03", svg);
}

// -------------------------------------------------------------------------------------------------
// 1.4 The erased hits

void add_pyramid(Scene& scene, const Point3& foot, float half, float height, const Color& color) {
    const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
    for (const auto& [x, z] : {std::pair{-half, half}, {half, half}, {half, -half}, {-half, -half}})
        scene.mesh.vertices.push_back(foot + Vector3(x, 0.0f, z));
    scene.mesh.vertices.push_back(foot + Vector3(0.0f, height, 0.0f));
    for (std::uint32_t side = 0; side < 4; ++side) {
        scene.mesh.faces.push_back({first + side, first + (side + 1) % 4, first + 4});
        scene.colors.push_back(color);
    }
}

/// Ten triangles: the ground, then two pyramids.
Scene two_pyramids() {
    Scene scene;
    scene.mesh.vertices = {{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}};
    scene.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    scene.colors = {{0.62f, 0.58f, 0.50f}, {0.62f, 0.58f, 0.50f}};
    add_pyramid(scene, {-0.9f, 0, -0.3f}, 1.0f, 1.9f, {0.05f, 0.30f, 0.60f});
    add_pyramid(scene, {1.2f, 0, 0.6f}, 0.8f, 1.4f, {0.80f, 0.25f, 0.03f});
    scene.camera = {
        .eye = {0.6f, 2.6f, 6.0f}, .target = {0.1f, 0.55f, 0.0f}, .field_of_view = 36.0f};
    scene.lights = {{{5.0f, 6.0f, 4.0f}, Color(150.0f)}, {{-4.0f, 5.0f, 6.0f}, Color(50.0f)}};
    scene.background = {0.72f, 0.82f, 0.88f};
    return scene;
}

/// The colour of a pixel's ray after each of the polygons: one pixel of the result for each.
template <class ColorOfRay>
Image states_of_the_loop(std::size_t polygons, const ColorOfRay& color_after) {
    Image states(static_cast<int>(polygons), 1);
    for (std::size_t count = 1; count <= polygons; ++count)
        states.at(static_cast<int>(count) - 1, 0) = color_after(count);
    return states;
}

void fig_01_04(const Options& options) {
    Svg svg("fig_01_04",
            "Algorithm 1 as printed and corrected: two pictures, and one pixel's colour after each "
            "polygon",
            640, 474);
    constexpr int width = 40, height = 30, pixel_x = 14, pixel_y = 15;
    const Scene scene = two_pyramids();
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const RenderSettings settings{.width = width, .height = height, .threads = options.threads};
    const Rendering printed = algorithm1_as_printed(scene, triangles, settings);
    const Rendering corrected = render(scene, Naive<>::build(triangles), settings);

    constexpr float pixel = 7.5f;
    const auto panel = [&](float left, const char* name, const Rendering& rendering,
                           std::string id) {
        svg.begin_group(id);
        svg.text({left + 150, 24}, name, {.size = 18, .bold = true});
        svg.picture({left, 38}, {width * pixel, height * pixel}, rendering.image);
        svg.rect({left, 38}, {width * pixel, height * pixel}, {.stroke = Ink::quiet});
        svg.rect({left + pixel_x * pixel - 2, 38 + pixel_y * pixel - 2}, {pixel + 4, pixel + 4},
                 {.stroke = Ink::vermillion}, "pixel-" + id);
        svg.text({left + 150, 288},
                 fmt::format("{} of {} hits shown", rendering.counts.hits, corrected.counts.hits),
                 {});
        svg.end_group();
    };
    panel(10, "as printed", printed, "printed");
    panel(330, "corrected", corrected, "corrected");

    // The loop over the polygons for the marked pixel, cut off after each of them.
    const CameraFrame frame(scene.camera);
    const Ray ray = camera_ray(scene.camera, frame, pixel_x + 0.5, pixel_y + 0.5, width, height);
    const auto first = [&](std::size_t count) { return std::span(triangles).first(count); };
    const Image printed_states = states_of_the_loop(triangles.size(), [&](std::size_t count) {
        return color_of_ray_as_printed(scene, first(count), ray).value_or(scene.background);
    });
    const Image corrected_states = states_of_the_loop(triangles.size(), [&](std::size_t count) {
        RenderCounts rays;
        NoCounts none;
        return color_of_ray(scene, Naive<>::build(first(count)), ray, rays, none);
    });
    constexpr float left = 160, cell = 46;
    svg.text({left - 14, 334}, "polygon", {.anchor = Anchor::end});
    const auto strip = [&](float top, const char* name, const Image& states) {
        svg.text({left - 14, top + 26}, name, {.anchor = Anchor::end});
        svg.picture({left, top}, {cell * static_cast<float>(triangles.size()), 40}, states);
        for (std::size_t i = 0; i < triangles.size(); ++i)
            svg.rect({left + cell * static_cast<float>(i), top}, {cell, 40},
                     {.stroke = Ink::quiet});
    };
    strip(374, "as printed", printed_states);
    strip(424, "corrected", corrected_states);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const float x = left + cell * (static_cast<float>(i) + 0.5f);
        const bool hit = MollerTrumbore::intersect(ray, triangles[i]).has_value();
        svg.text({x, 334}, fmt::format("{}", i + 1),
                 {.ink = hit ? Ink::ink : Ink::quiet, .bold = hit});
        if (hit) svg.circle({x, 354}, 5, {.stroke = {}, .fill = Ink::ink});
    }
    svg.text({left - 14, 360}, "is hit", {.anchor = Anchor::end});
    write(options, "fig_01_04", svg);
}

// -------------------------------------------------------------------------------------------------
// 1.5 The two renderers

void fig_01_05(const Options& options) {
    Svg svg("fig_01_05",
            "The room by the ray tracer and by the rasteriser; circles mark the pixels that see "
            "another triangle",
            640, 330);
    constexpr int width = 300, height = 225;
    const Scene scene = make_scene("room:1");
    const auto naive = Naive<>::build(scene.mesh.triangles());
    const RenderSettings settings{.width = width, .height = height, .threads = options.threads};
    Progress progress("fig_01_05", height);
    const Image traced = render<NoCounts>(scene, naive, settings, &progress).image;
    const DepthBuffer traced_depth =
        trace_depth(scene.camera, naive, width, height, options.threads);
    const DepthBuffer rasterised_depth = rasterise(scene, width, height);
    const Coverage coverage = compare_coverage(scene, traced_depth, rasterised_depth);

    svg.text({160, 24}, "ray tracer", {.size = 18, .bold = true});
    svg.picture({10, 38}, {width, height}, traced, "ray-tracer");
    svg.text({480, 24}, "rasteriser", {.size = 18, .bold = true});
    svg.picture({330, 38}, {width, height}, render_rasterised(scene, width, height), "rasteriser");
    svg.begin_group("differences");
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Hit &one = traced_depth.at(x, y), &other = rasterised_depth.at(x, y);
            if (one.t == infinity && other.t == infinity) continue;
            if (one.t < infinity && other.t < infinity && one.triangle == other.triangle) continue;
            for (const float left : {10.0f, 330.0f})
                svg.circle({left + static_cast<float>(x) + 0.5f, 38.5f + static_cast<float>(y)}, 6,
                           {.stroke = Ink::yellow});
        }
    svg.end_group();
    svg.text({320, 292},
             fmt::format("{} of {} pixels see another triangle:", coverage.disagree,
                         with_commas(coverage.pixels)),
             {});
    svg.text({320, 316},
             fmt::format("all within {} pixels of an edge",
                         shown(coverage_distance(scene.camera, width, height), 4)),
             {});
    write(options, "fig_01_05", svg);
}

// -------------------------------------------------------------------------------------------------
// 1.6, 1.7 Times

void fig_01_06(const Options& options) {
    write_chart(options.out, growth_chart(measure_growth(options)));
}

void fig_01_07(const Options& options) {
    write_chart(options.out, share_chart(measure_shares(options)));
}

// -------------------------------------------------------------------------------------------------
// 1.8 Speed and accuracy: float and double

void fig_01_08(const Options& options) {
    write_chart(options.out, accuracy_chart(measure_leaks(options)));
}

// -------------------------------------------------------------------------------------------------
// 1.9 The room

void fig_01_09(const Options& options) {
    const Scene scene = make_scene("room");
    const RenderSettings settings{
        .width = 640, .height = 480, .samples = 2, .threads = options.threads};
    Progress progress("fig_01_09", static_cast<std::size_t>(settings.height));
    write_png(
        options.out / "fig_01_09.png",
        render<NoCounts>(scene, Naive<>::build(scene.mesh.triangles()), settings, &progress).image);
}

// -------------------------------------------------------------------------------------------------

constexpr Figure figures[] = {
    {"fig_01_01", FigureKind::drawing, fig_01_01},   {"fig_01_02", FigureKind::drawing, fig_01_02},
    {"fig_01_03", FigureKind::drawing, fig_01_03},   {"fig_01_04", FigureKind::drawing, fig_01_04},
    {"fig_01_05", FigureKind::drawing, fig_01_05},   {"fig_01_06", FigureKind::chart, fig_01_06},
    {"fig_01_07", FigureKind::chart, fig_01_07},     {"fig_01_08", FigureKind::chart, fig_01_08},
    {"fig_01_09", FigureKind::rendering, fig_01_09},
};

}  // namespace

std::span<const Figure> chapter01_figures() {
    return figures;
}

}  // namespace space::ch01
