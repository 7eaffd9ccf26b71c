#include "chapters/ch02_intersection_tests/figures.hpp"
#include "chapters/ch02_intersection_tests/figures/pixel.hpp"
#include "chapters/ch02_intersection_tests/measured/exact_deciders.hpp"
#include "chapters/ch02_intersection_tests/shape_tests.hpp"
#include "common/program/image.hpp"
#include "common/program/report.hpp"

#include <algorithm>

namespace space::ch02 {
namespace {

struct SpherePicture {
    Image image{0, 0};
    int wrong = 0;
};

/// The unit sphere by parallel rays from this distance: shaded where a hit is right, marked where
/// the decision is wrong.
template <class Test>
SpherePicture sphere_picture(int side, double distance) {
    const Sphere sphere;
    const Double3 back{0.6, 0.48, 0.64}, right{0.8, -0.36, -0.48},
        up{0.0, 0.8, -0.6};  // orthonormal
    SpherePicture picture{.image = Image(side, side)};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double across = 2.2 * (x + 0.5) / side - 1.1,
                         above = 1.1 - 2.2 * (y + 0.5) / side;
            const Ray ray{.origin = Point3(distance * back + across * right + above * up),
                          .direction = Vector3(-back)};
            const auto t = Test::intersect(ray, sphere);
            const bool wrong = t.has_value() != exactly_hits_ahead(ExactQuadratic(ray, sphere));
            picture.wrong += wrong;
            Vector3& color = picture.image.at(x, y);
            color = wrong ? pixel(Ink::vermillion) : Vector3(1.0f);
            if (t && !wrong) {
                const Double3 n =
                    glm::normalize(Double3(ray.origin) + double{*t} * Double3(ray.direction));
                const double light =
                    std::max(0.0, glm::dot(n, glm::normalize(back + 0.7 * up - 0.6 * right)));
                color =
                    Vector3(glm::mix(Double3(0.03, 0.09, 0.16), Double3(0.35, 0.75, 0.95), light));
            }
        }
    return picture;
}

}  // namespace

Svg fig_02_08(const Options&) {
    Svg svg(
        "The ray's point nearest to a sphere's centre, and a sphere seen from 3,000 radii away "
        "by three formulas",
        640, 568);
    const Sphere sphere{.centre = {390.0f, 168.0f, 0.0f}, .radius = 112.0f};
    const Ray ray{.origin = {50.0f, 150.0f, 0.0f},
                  .direction = glm::normalize(Vector3{1.0f, -0.14f, 0.0f})};
    const Vector3& d = ray.direction;
    const Vector3 f = ray.origin - sphere.centre;
    const Point3 nearest = ray.at(-glm::dot(f, d));
    const float t0 = SphereStable::intersect(ray, sphere).value();
    const Point3 enter = ray.at(t0),
                 leave = ray.at(SphereStable::intersect(Ray{ray.at(t0 + 1.0f), d}, sphere).value() +
                                t0 + 1.0f);
    const auto flat = [](const Point3& p) { return Point2(p); };
    svg.circle(flat(sphere.centre), sphere.radius, {.fill = Ink::sky, .opacity = 0.35}, "sphere");
    svg.line(flat(ray.origin), flat(sphere.centre), {.stroke = Ink::blue});
    svg.line(flat(sphere.centre), flat(nearest), {.stroke = Ink::green});
    svg.line(flat(sphere.centre), flat(enter), {.stroke = Ink::quiet, .dashed = true});
    svg.line(flat(ray.origin), flat(ray.at(560)), {.stroke = Ink::vermillion, .arrow = true});
    const Vector2 along = 12.0f * Vector2(d),
                  across = 12.0f * glm::normalize(Vector2(sphere.centre - nearest));
    svg.polyline({flat(nearest) - along, flat(nearest) - along + across, flat(nearest) + across},
                 {.stroke = Ink::quiet});
    for (const Point3& p : {ray.origin, sphere.centre, nearest, enter, leave})
        svg.circle(flat(p), 5, {.stroke = {}, .fill = Ink::ink});
    svg.text(moved(flat(ray.origin), 0, -14), "*O*", {.size = 20});
    svg.text(moved(flat(sphere.centre), 16, 16), "*C*", {.size = 20});
    svg.text(moved(flat(nearest), 6, -12), "*N*", {.size = 20, .halo = true});
    svg.text(moved(flat(enter), -14, -10), "*t*_0", {.size = 20, .halo = true});
    svg.text(moved(flat(leave), 16, -12), "*t*_1", {.size = 20, .halo = true});
    svg.text(moved(0.5f * flat(ray.origin + sphere.centre), -20, 28), "*g*",
             {.ink = Ink::blue, .size = 20});
    svg.text(moved(0.5f * flat(sphere.centre + nearest), 8, 8), "*N* − *C*",
             {.anchor = Anchor::start, .ink = Ink::green, .size = 20});
    svg.text(moved(0.5f * flat(sphere.centre + enter), -10, 20), "*r*",
             {.ink = Ink::ink, .size = 20});
    svg.text({130, 246}, "half a chord, squared:", {});
    svg.text({130, 276}, "*r*² − |*N* − *C*|²", {.size = 20});

    constexpr int side = 96;
    constexpr float size = 192;
    const auto panel = [&](float left, const char* name, const SpherePicture& picture) {
        svg.picture({left, 310}, {size, size}, picture.image, name);
        svg.text({left + size / 2, 528}, name, {.bold = true});
        svg.text({left + size / 2, 554},
                 picture.wrong ? with_commas(static_cast<std::uint64_t>(picture.wrong)) + " wrong"
                               : "none wrong",
                 {.ink = picture.wrong ? Ink::vermillion : Ink::ink});
    };
    panel(8, "schoolbook", sphere_picture<SphereSchoolbook>(side, 3000.0));
    panel(224, "stable", sphere_picture<SphereStable>(side, 3000.0));
    panel(440, "in double", sphere_picture<SphereDouble>(side, 3000.0));
    return svg;
}

}  // namespace space::ch02
