#include "chapters/ch02_intersection_tests/figures/drawings.hpp"

#include "chapters/ch02_intersection_tests/measured/exact_deciders.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "chapters/ch02_intersection_tests/shape_tests.hpp"
#include "chapters/ch02_intersection_tests/square_roots.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/program/file.hpp"
#include "common/program/image.hpp"
#include "common/program/report.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace space::ch02 {
namespace {

void write(const Options& options, const char* id, const Svg& svg) {
    write_file(options.out / (std::string(id) + ".svg"), svg.document());
}

Point2 at(double x, double y) {
    return Point2(glm::dvec2(x, y));
}
Point2 moved(const Point2& p, double x, double y) {
    return p + at(x, y);
}

/// The palette's colour as a picture's pixel: linear.
Vector3 pixel(Ink ink) {
    Vector3 linear;
    const std::string hex(svg_color(ink).substr(1));
    for (int channel = 0; channel < 3; ++channel) {
        const double encoded =
            std::stoi(hex.substr(2 * static_cast<std::size_t>(channel), 2), nullptr, 16) / 255.0;
        linear[channel] = static_cast<float>(std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    return linear;
}

void bar(Svg& svg, double left, double right, double y, double height, Ink ink,
         double opacity = 1.0) {
    svg.rect(at(left, y), at(right - left, height),
             {.stroke = {}, .fill = ink, .opacity = opacity});
}

// -------------------------------------------------------------------------------------------------
// 2.1 Two triangles, one edge

/// A quadrilateral, cut along the diagonal from a to c.
constexpr Point3 corner_a{-1.0625f, -1.125f, -0.125f}, corner_b{0.75f, -0.875f, 0.0625f},
    corner_c{1.1875f, 1.0625f, 0.0f}, corner_d{-1.0625f, 0.8125f, -0.125f};
constexpr Triangle lower{corner_a, corner_b, corner_c}, upper{corner_a, corner_c, corner_d};

/// Meets the diagonal at t = 1.
constexpr Ray aim{.origin = {3.0f, 2.0f, 5.0f}, .direction = {-2.26249981f, -1.375f, -5.0250001f}};

struct SharedEdge {
    Image image{0, 0};
    int neither = 0;
};

/// Rays in directions next to that of `aim`: which triangle says that it is hit?
template <class Test>
SharedEdge shared_edge(int side) {
    constexpr float step =
        0x1p-22f;  // between neighbouring floats of direction.x; every other one of direction.y
    SharedEdge result{.image = Image(side, side)};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const Vector3 offset(static_cast<float>(x - side / 2) * step,
                                 static_cast<float>(side / 2 - y) * step, 0.0f);
            const Ray ray{.origin = aim.origin, .direction = aim.direction + offset};
            const bool hits_lower = Test::intersect(ray, lower).has_value(),
                       hits_upper = Test::intersect(ray, upper).has_value();
            result.neither += !hits_lower && !hits_upper;
            result.image.at(x, y) = pixel(hits_lower && hits_upper ? Ink::blue
                                          : hits_lower             ? Ink::sky
                                          : hits_upper             ? Ink::yellow
                                                                   : Ink::vermillion);
        }
    return result;
}

}  // namespace

void draw_shared_edge(const Options& options) {
    Svg svg("fig_02_01",
            "Two triangles with a common edge, and the rays about it under a magnifying glass, for "
            "three tests",
            640, 566);
    const auto view = [](const Point3& p) { return at(150 + 110 * p.x, 132 - 100 * p.y); };
    svg.polygon({view(corner_a), view(corner_b), view(corner_c)},
                {.fill = Ink::sky, .opacity = 0.6}, "lower");
    svg.polygon({view(corner_a), view(corner_c), view(corner_d)},
                {.fill = Ink::yellow, .opacity = 0.6}, "upper");
    const Point2 a = view(corner_a), c = view(corner_c);
    const Vector2 along = glm::normalize(c - a), across(-along.y, along.x);
    const auto beside = [&](float share, float distance) {
        return a + share * (c - a) + distance * across;
    };
    svg.line(beside(0.62f, 14), beside(0.3f, 14), {.stroke = Ink::blue, .arrow = true});
    svg.line(beside(0.3f, -14), beside(0.62f, -14), {.stroke = Ink::vermillion, .arrow = true});
    svg.circle(view(aim.at(1.0f)), 9, {.stroke = Ink::ink}, "glass");
    const std::array<std::pair<Point2, const char*>, 4> names{
        {{moved(a, -14, 14), "*a*"},
         {moved(view(corner_b), 14, 14), "*b*"},
         {moved(c, 14, 0), "*c*"},
         {moved(view(corner_d), -14, 2), "*d*"}}};
    for (const auto& [where, name] : names) svg.text(where, name, {.size = 20});
    svg.text({318, 62}, "*a b c* asks: left of *c* → *a*?",
             {.anchor = Anchor::start, .ink = Ink::blue});
    svg.text({318, 92}, "*a c d* asks: left of *a* → *c*?",
             {.anchor = Anchor::start, .ink = Ink::vermillion});
    svg.text({318, 136}, "Exactly:", {.anchor = Anchor::start});
    svg.text({318, 162}, "*E*_{ca} = −*E*_{ac}:", {.anchor = Anchor::start, .size = 20});
    svg.text({318, 192}, "one of the two says yes.", {.anchor = Anchor::start});
    svg.text({318, 218}, "Rounded: see below.", {.anchor = Anchor::start});

    constexpr int side = 40;
    constexpr float size = 200;
    const auto panel = [&](float left, const char* name, const SharedEdge& edge) {
        svg.picture({left, 260}, {size, size}, edge.image, name);
        svg.rect({left, 260}, {size, size}, {.stroke = Ink::quiet});
        svg.text({left + size / 2, 484}, name, {.size = 17, .bold = true});
        svg.text({left + size / 2, 508},
                 edge.neither ? fmt::format("{} leaks", edge.neither) : "no leak",
                 {.ink = edge.neither ? Ink::vermillion : Ink::ink, .size = 17});
    };
    panel(4, "Möller–Trumbore", shared_edge<MollerTrumboreFloat>(side));
    panel(220, "watertight", shared_edge<Watertight>(side));
    panel(436, "exact", shared_edge<FilteredExact>(side));
    const std::array<std::tuple<float, Ink, const char*>, 4> legend{
        {{10, Ink::sky, "only *a b c*"},
         {176, Ink::yellow, "only *a c d*"},
         {342, Ink::blue, "both"},
         {446, Ink::vermillion, "neither: a leak"}}};
    for (const auto& [left, ink, label] : legend) {
        svg.rect({left, 533}, {20, 20}, {.stroke = Ink::quiet, .fill = ink});
        svg.text({left + 28, 549}, label, {.anchor = Anchor::start, .size = 17});
    }
    write(options, "fig_02_01", svg);
}

// -------------------------------------------------------------------------------------------------
// 2.2 Slabs

void draw_slabs(const Options& options) {
    Svg svg("fig_02_02",
            "A ray in two slabs, the intervals of t in each, and their common part; below, what "
            "five tests miss",
            640, 712);
    const Aabb box{{2.2f, 1.2f, -1.0f}, {4.4f, 2.6f, 1.0f}};
    const Ray ray{.origin = {0.4f, 0.1f, 0.0f}, .direction = {1.0f, 0.5f, 0.0f}};
    constexpr double scale = 100, floor = 310;
    const auto view = [](double x, double y) { return at(scale * x, floor - scale * y); };
    const auto on_ray = [&](double t) {
        return view(ray.origin.x + t * ray.direction.x, ray.origin.y + t * ray.direction.y);
    };
    struct Slab {
        double near, far;
    };
    const auto slab = [&](int axis) {
        return Slab{(double{box.min[axis]} - ray.origin[axis]) / ray.direction[axis],
                    (double{box.max[axis]} - ray.origin[axis]) / ray.direction[axis]};
    };
    const Slab x = slab(0), y = slab(1);
    const Interval both = SlabSafe::intersect(ray, box).value();

    svg.rect(view(box.min.x, 3.1), at(scale * (box.max.x - box.min.x), floor + 10),
             {.stroke = {}, .fill = Ink::sky, .opacity = 0.35}, "x-slab");
    svg.rect(view(0, box.max.y), at(640, scale * (box.max.y - box.min.y)),
             {.stroke = {}, .fill = Ink::orange, .opacity = 0.3}, "y-slab");
    constexpr double axis = 372;  // of t: d.x is 1, so that each mark stands below its point
    const std::array<std::pair<double, double>, 4> marks{
        {{x.near, axis}, {x.far, axis}, {y.near, axis + 30}, {y.far, axis + 30}}};
    for (const auto& [t, down] : marks)
        svg.line(moved(on_ray(t), 0, 6), at(on_ray(t).x, down), {.stroke = Ink::faint});
    svg.rect(view(box.min.x, box.max.y),
             at(scale * (box.max.x - box.min.x), scale * (box.max.y - box.min.y)), {}, "box");
    svg.line(on_ray(0), on_ray(5.65), {.stroke = Ink::vermillion, .arrow = true});
    svg.circle(on_ray(0), 5, {.stroke = {}, .fill = Ink::vermillion});
    svg.text(moved(on_ray(0), 0, -14), "*O*", {.size = 20});
    svg.text(moved(view(box.min.x, 3.1), 8, 22), "*x* slab",
             {.anchor = Anchor::start, .ink = Ink::blue});
    svg.text(moved(view(0, box.max.y), 8, 24), "*y* slab", {.anchor = Anchor::start});

    for (const auto& [t, down] : marks) svg.circle(on_ray(t), 5, {.fill = Ink::paper});
    const auto interval = [&](double y_of, double near, double far, Ink ink,
                              const std::string& label) {
        bar(svg, on_ray(near).x, on_ray(far).x, y_of, 16, ink);
        svg.text(at(on_ray(near).x - 10, y_of + 15), label, {.anchor = Anchor::end});
        svg.text(at(on_ray(far).x + 10, y_of + 15), fmt::format("{:.1f} .. {:.1f}", near, far),
                 {.anchor = Anchor::start});
    };
    interval(axis - 10, x.near, x.far, Ink::sky, "in the *x* slab");
    interval(axis + 20, y.near, y.far, Ink::orange, "in the *y* slab");
    interval(axis + 50, both.enter, both.leave, Ink::green, "in the box");

    // Rays in the planes of faces.
    svg.text({320, 478}, "0 · ∞ is not a number: rays in planes of faces",
             {.size = 19, .bold = true});
    const std::vector<RayAndBox> lattice = lattice_boxes();
    std::array<int, box_test_count> missed{};
    int hits = 0;
    for (const RayAndBox& pair : lattice) {
        if (!exactly_hits(pair.ray, pair.box)) continue;
        ++hits;
        for_each_named(box_tests, [&](std::size_t i, const auto& named) {
            missed[i] += !TestOf<decltype(named)>::intersect(pair.ray, pair.box);
        });
    }
    svg.text({320, 504},
             fmt::format("missed of {} hits", with_commas(static_cast<std::uint64_t>(hits))),
             {.ink = Ink::quiet});
    double top = 522;
    for_each_named(box_tests, [&](std::size_t i, const auto& named) {
        if (named.name == "as printed") return;
        svg.text(at(150, top + 17), named.name, {.anchor = Anchor::end});
        bar(svg, 164, 164 + 400.0 * missed[i] / hits + 2, top, 22,
            missed[i] ? Ink::vermillion : Ink::green);
        svg.text(at(164 + 400.0 * missed[i] / hits + 12, top + 17),
                 missed[i] ? with_commas(static_cast<std::uint64_t>(missed[i])) : "none",
                 {.anchor = Anchor::start});
        top += 36;
    });
    write(options, "fig_02_02", svg);
}

// -------------------------------------------------------------------------------------------------
// 2.3 The filter

namespace {

/// "10^-3" as "10⁻³".
std::string with_powers(const std::string& text) {
    constexpr const char* raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    const std::size_t caret = text.find('^');
    std::string result = text.substr(0, caret);
    for (std::size_t i = std::min(caret, text.size() - 1) + 1; i < text.size(); ++i)
        result += text[i] == '-' ? "⁻" : raised[text[i] - '0'];
    return result;
}

/// A share of all, never rounded to all.
std::string percent(int part, int all) {
    if (part < all && 10'000 * (all - part) < all) return "> 99.99 %";
    return fmt::format("{:.{}f} %", 100.0 * part / all, part == all ? 0 : 2);
}

struct StageCounts {
    std::array<int, 3> count{};
    void decided(Stage stage) { ++count[static_cast<std::size_t>(stage)]; }
};

}  // namespace

void draw_filter(const Options& options) {
    const std::vector<TriangleInput>& inputs = triangle_inputs();
    constexpr int row = 34, head = 262;
    Svg svg(
        "fig_02_03",
        "The filter's number line, and the share of the rays that each of the three stages decides",
        640, head + row * static_cast<double>(inputs.size()) + 54);

    // The number line of one volume.
    constexpr double y = 96, zero = 210, size = 470, bound = 42;
    bar(svg, 20, zero - bound, y - 14, 28, Ink::faint);
    bar(svg, zero - bound, zero + bound, y - 14, 28, Ink::orange, 0.8);
    bar(svg, zero + bound, size - bound, y - 14, 28, Ink::green, 0.8);
    bar(svg, size - bound, size + bound, y - 14, 28, Ink::orange, 0.8);
    bar(svg, size + bound, 606, y - 14, 28, Ink::faint);
    svg.line({20, y}, {626, y}, {.arrow = true});
    const auto mark = [&](double x, const char* label) {
        svg.line(at(x, y - 22), at(x, y + 22));
        svg.text(at(x, y + 44), label, {});
    };
    mark(zero, "0");
    mark(size, "|*det*|");
    const auto name = [&](double x, const char* label) {
        svg.text(at(x, y - 30), label, {.bold = true});
    };
    name(92, "miss");
    name(zero, "unsure");
    name(0.5 * (zero + size), "inside");
    name(size, "unsure");
    name(572, "miss");
    const auto reach = [&](double x) {
        svg.line(at(x, y + 56), at(x - bound, y + 56), {.arrow = true});
        svg.line(at(x, y + 56), at(x + bound, y + 56), {.arrow = true});
        svg.text(at(x, y + 80), "± bound", {});
    };
    reach(zero);
    reach(size);
    svg.text({320, 30}, "a computed volume (the bound drawn far too wide)", {.ink = Ink::quiet});

    // Who decides.
    constexpr int pairs = 20'000;
    constexpr double left = 176, right = 520;
    svg.text({320, 226}, fmt::format("who decides, of {} rays each", with_commas(pairs)),
             {.ink = Ink::quiet});
    const std::array<Ink, 3> inks{Ink::green, Ink::orange, Ink::purple};
    double top = head - 16;
    for (const TriangleInput& input : inputs) {
        Pcg32 random(options.seed);
        StageCounts stages;
        for (int i = 0; i < pairs; ++i) {
            const auto [ray, triangle] = make_pair(input, random);
            FilteredExact::intersect(ray, triangle, stages);
        }
        svg.text(at(left - 12, top + 18), with_powers(input.name),
                 {.anchor = Anchor::end, .size = 17});
        double x = left;
        for (std::size_t stage = 0; stage < 3; ++stage) {
            const double next = x + (right - left) * stages.count[stage] / pairs;
            if (stages.count[stage]) bar(svg, x, std::max(next, x + 1), top, 24, inks[stage], 0.85);
            x = next;
        }
        svg.text(at(right + 12, top + 18), percent(stages.count[0], pairs),
                 {.anchor = Anchor::start, .size = 17});
        top += row;
    }
    const std::array<std::tuple<float, Ink, const char*>, 3> legend{
        {{60, inks[0], "filter in double"},
         {254, inks[1], "128-bit integers"},
         {450, inks[2], "expansions"}}};
    for (const auto& [x, ink, label] : legend) {
        svg.rect(at(x, top + 14), at(20, 20), {.stroke = Ink::quiet, .fill = ink, .opacity = 0.85});
        svg.text(at(x + 28, top + 30), label, {.anchor = Anchor::start, .size = 17});
    }
    write(options, "fig_02_03", svg);
}

// -------------------------------------------------------------------------------------------------
// 2.4 The sphere's discriminant

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

void draw_sphere(const Options& options) {
    Svg svg("fig_02_04",
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
    svg.text(moved(0.5f * flat(ray.origin + sphere.centre), -20, 28), "*f*",
             {.ink = Ink::blue, .size = 20});
    svg.text(moved(0.5f * flat(sphere.centre + nearest), 14, 8), "*n*",
             {.ink = Ink::green, .size = 20});
    svg.text(moved(0.5f * flat(sphere.centre + enter), -10, 20), "*r*",
             {.ink = Ink::ink, .size = 20});
    svg.text({130, 246}, "half a chord, squared:", {});
    svg.text({130, 276}, "*r*² − |*n*|²", {.size = 20});

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
    write(options, "fig_02_04", svg);
}

// -------------------------------------------------------------------------------------------------
// 2.5 Newton's square root

void draw_newton_root(const Options& options) {
    Svg svg("fig_02_05",
            "A float's bits are nearly its logarithm; the error of the square root after each "
            "round of Newton's method",
            640, 612);
    constexpr double left = 62, right = 540;
    const auto x_of = [](double a) {
        return left + (right - left) * 0.5 * std::log2(a);
    };  // from 1 to 4

    // Bits as a logarithm.
    constexpr double low = 222, unit = 92;
    const auto y_of = [](double log) { return low - unit * log; };
    svg.text({left, 24}, "the float's bits / 2²³ − 127",
             {.anchor = Anchor::start, .ink = Ink::vermillion});
    for (int i = 0; i <= 2; ++i) {
        svg.line(at(left, y_of(i)), at(right, y_of(i)), {.stroke = Ink::faint});
        svg.line(at(x_of(std::ldexp(1.0, i)), y_of(0)), at(x_of(std::ldexp(1.0, i)), y_of(2)),
                 {.stroke = Ink::faint});
        svg.text(at(left - 12, y_of(i) + 6), fmt::format("{}", i), {.anchor = Anchor::end});
        svg.text(at(x_of(std::ldexp(1.0, i)), y_of(0) + 26), fmt::format("{}", 1 << i), {});
    }
    svg.text(at(x_of(2.8), y_of(0) + 26), "*a*", {.size = 20});
    std::vector<Point2> bits;
    for (int i = 0; i <= 192; ++i) {
        const float a = static_cast<float>(std::exp2(i / 96.0));
        bits.push_back(at(
            x_of(a),
            y_of(std::ldexp(static_cast<double>(std::bit_cast<std::uint32_t>(a)), -23) - 127.0)));
    }
    svg.line(at(x_of(1), y_of(0)), at(x_of(4), y_of(2)), {.stroke = Ink::blue});
    svg.polyline(bits, {.stroke = Ink::vermillion});
    svg.text(at(x_of(1.9) - 34, y_of(1) - 22), "log_2 *a*", {.ink = Ink::blue, .size = 20});

    // The error after each round.
    constexpr double top = 296, decade = 34;
    const auto y_of_error = [](double error) {
        return top - decade * std::log10(std::max(error, 1e-8)) - decade;
    };
    svg.text({left, top - 12}, "relative error of the root", {.anchor = Anchor::start});
    constexpr const char* powers[] = {"10⁻¹", "10⁻²", "10⁻³", "10⁻⁴",
                                      "10⁻⁵", "10⁻⁶", "10⁻⁷", "10⁻⁸"};
    for (int i = 0; i < 8; ++i) {
        const double y = top + decade * i;
        svg.line(at(left, y), at(right, y), {.stroke = Ink::faint});
        if (i % 2 == 0 || i == 7)
            svg.text(at(left - 8, y + 6), powers[i], {.anchor = Anchor::end, .size = 17});
    }
    for (int i = 0; i <= 2; ++i) {
        svg.line(at(x_of(std::ldexp(1.0, i)), top), at(x_of(std::ldexp(1.0, i)), top + 7 * decade),
                 {.stroke = Ink::faint});
        svg.text(at(x_of(std::ldexp(1.0, i)), top + 7 * decade + 28), fmt::format("{}", 1 << i),
                 {});
    }
    svg.text(at(x_of(2.8), top + 7 * decade + 28), "*a*", {.size = 20});
    const auto rounds = [&](float (*root)(float), Ink ink, const char* label, double lowered = 6) {
        constexpr int windows = 240,
                      samples =
                          32;  // the worst of each window: rounding is noise, and noise is no line
        std::vector<Point2> line;
        double last = 0.0;
        for (int window = 0; window < windows; ++window) {
            double worst = 0.0;
            for (int i = 0; i < samples; ++i) {
                const auto a =
                    static_cast<float>(std::exp2(2.0 * (window + (i + 0.5) / samples) / windows));
                worst = std::max(worst, std::abs(root(a) / std::sqrt(double{a}) - 1.0));
            }
            line.push_back(at(x_of(std::exp2(2.0 * (window + 0.5) / windows)), y_of_error(worst)));
            last = worst;
        }
        svg.polyline(line, {.stroke = ink});
        svg.text(at(right + 10, y_of_error(last) + lowered), label,
                 {.anchor = Anchor::start, .ink = ink == Ink::orange ? Ink::ink : ink, .size = 17});
    };
    rounds(newton_root<0>, Ink::vermillion, "guess");
    rounds(newton_root<1>, Ink::orange, "1 round");
    rounds(newton_root<2>, Ink::blue, "2 rounds", -4);
    rounds(newton_root<3>, Ink::green, "3 rounds", 16);
    write(options, "fig_02_05", svg);
}

}  // namespace space::ch02
