#include "chapters/ch01_naive_ray_tracing/coordinate_systems.hpp"
#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/figures/parallel_view.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace space::ch01 {
namespace {

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

void draw_house(Svg& svg, const ParallelView& view, const Map& map) {
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
void draw_axes(Svg& svg, const ParallelView& view, const Map& map, double length, Ink ink) {
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
void draw_camera(Svg& svg, const ParallelView& view, const Map& camera_to_drawn,
                 double tan_half_fov, double distance) {
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

std::string coordinates(const Double3& p) {
    return fmt::format("({}, {}, {})", shown(p.x, 1), shown(p.y, 1), shown(p.z, 1));
}

}  // namespace

Svg fig_01_02(const Options&) {
    Svg svg("One house in its local coordinates, in the world's, and in the camera's", 640, 570);
    const Camera camera{
        .eye = {-2.2f, 1.5f, 1.6f}, .target = {1.4f, 0.4f, -1.2f}, .field_of_view = 40.0f};
    const CameraFrame frame(camera);
    const Map from_camera = camera_to_world(camera), to_camera = glm::inverse(from_camera);
    const Map placed =
        local_to_world({.translation = {1.1, 0.0, -0.4}, .angle = -0.3, .scale = Double3(1.3)});
    const Double3 tip = map_point(placed, house_tip);

    const ParallelView local{{70, 204}, 86, 12.0 / 13, 5.0 / 13, 12.0 / 13, 5.0 / 13};
    const ParallelView world{{290, 440}, 68, 12.0 / 13, 5.0 / 13, 15.0 / 17, 8.0 / 17};
    const ParallelView seen{{412, 204}, 36, 5.0 / 13, 12.0 / 13, 12.0 / 13, 5.0 / 13};

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
        svg.text(moved(at, 0, 26), "*P* = " + coordinates(p), {.size = 18});
    };
    heading({110, 28}, "local", Ink::blue, house_tip);
    heading({520, 28}, "camera", Ink::vermillion, world_to_camera(camera, frame, tip));
    heading({130, 524}, "world", Ink::ink, tip);
    svg.line({110, 250}, {146, 306}, {.stroke = Ink::quiet, .arrow = true}, "local-to-world");
    svg.text({144, 276}, "*M* = *T R S*", {.anchor = Anchor::start, .size = 18, .halo = true});
    svg.line({500, 306}, {530, 250}, {.stroke = Ink::quiet, .arrow = true}, "world-to-camera");
    svg.text({532, 290}, "*V*", {.anchor = Anchor::start, .size = 18, .halo = true});
    return svg;
}

}  // namespace space::ch01
