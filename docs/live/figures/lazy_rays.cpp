#include "chapters/ch05_lazy_kd_trees/figures/drawn_rays.hpp"
#include "docs/live/live.hpp"
#include "docs/live/plane_handles.hpp"

#include <fmt/format.h>

#include <array>

namespace space::live {
namespace {

using namespace std::string_view_literals;
using Rule = LazyKdTreeConfig::Rule;

constexpr std::array who{"three rays"sv, "a fan of rays"sv};
constexpr std::array lazy_rules{"at the median"sv, "in the middle"sv, "surface area heuristic"sv};

Ray2 ray_through(const Point2& from, const Point2& to) {
    return {.origin = from, .direction = from == to ? Vector2(1.0f, 0.0f) : to - from};
}

void move_each(PlaneHandles& handles, std::vector<Ray2>& rays) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto handle = [&](const char* name, const char* label, const Point2& first) {
            return handles.at(ch05::rays_view(), Double2(heinonen_size),
                              fmt::format("{}{}", name, i + 1), fmt::format("{} {}", label, i + 1),
                              first);
        };
        const Point2 from = handle("ray", "start of ray", rays[i].origin);
        rays[i] = ray_through(
            from, handle("to", "a point on ray", rays[i].origin + 4.0f * rays[i].direction));
    }
}

/// Rays from one place to evenly spaced points between two others.
std::vector<Ray2> fan_of(PlaneHandles& handles, std::size_t count) {
    const auto handle = [&](const char* name, const char* label, const Point2& first) {
        return handles.at(ch05::rays_view(), Double2(heinonen_size), name, label, first);
    };
    const Point2 eye = handle("eye", "where the fan starts", {0.5f, 8.0f}),
                 first = handle("first", "a point on the fan's first ray", {7.5f, 14.5f}),
                 last = handle("last", "a point on the fan's last ray", {9.0f, 11.5f});
    std::vector<Ray2> rays;
    for (std::size_t i = 0; i < count; ++i)
        rays.push_back(
            ray_through(eye, first + float(i) / float(count - 1) * Vector2(last - first)));
    return rays;
}

}  // namespace

Answer lazy_rays(const State& state) {
    ch05::LazyRays asked;
    const std::size_t by = state.choice("rays", 0, who), rule = state.choice("rule", 0, lazy_rules);
    asked.fan = by == 1;
    constexpr std::array of_rule{Rule::median, Rule::middle, Rule::sah};
    asked.rule = of_rule[rule];
    asked.max_depth = state.whole("depth", asked.max_depth, 1, 5);
    std::vector<Slider> sliders{{"depth", "Depth at most", double(asked.max_depth), 1.0, 5.0, 1.0}};
    PlaneHandles handles(state);
    if (asked.fan) {
        const std::size_t count = state.whole("count", 12, 2, 48);
        sliders.push_back({"count", "Rays of the fan", double(count), 2.0, 48.0, 1.0});
        asked.rays = fan_of(handles, count);
    } else {
        move_each(handles, asked.rays);
    }
    ch05::DrawnRays drawn = ch05::drawn_rays(asked);
    return {.drawing = std::move(drawn.drawing),
            .summary = std::move(drawn.tells),
            .handles = std::move(handles.handles),
            .choices = {{"rays", "Who asks", who, by}, {"rule", "Cells are cut", lazy_rules, rule}},
            .sliders = std::move(sliders)};
}

}  // namespace space::live
