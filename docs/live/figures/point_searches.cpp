#include "chapters/ch04_kd_trees/figures/drawn_searches.hpp"
#include "docs/live/live.hpp"
#include "docs/live/plane_handles.hpp"

namespace space::live {

Answer point_searches(const State& state) {
    ch04::Searches asked;
    PlaneHandles handles(state);
    const auto point = [&](std::size_t search, const char* name, const char* label,
                           const Point2& first) {
        return handles.at(ch04::search_view(search), Double2(10.0), name, label, first);
    };
    asked.query = point(0, "place", "the place whose nearest points are asked for", asked.query);
    const Point2 one = point(1, "corner", "a corner of the box", asked.box.min),
                 other = point(1, "opposite", "the opposite corner of the box", asked.box.max);
    asked.box = {glm::min(one, other), glm::max(one, other)};
    asked.k = state.whole("k", asked.k, 1, 12);
    ch04::DrawnSearches drawn = ch04::drawn_searches(asked);
    return {.drawing = std::move(drawn.drawing),
            .summary = std::move(drawn.tells),
            .handles = std::move(handles.handles),
            .sliders = {{"k", "How many nearest", double(asked.k), 1.0, 12.0, 1.0}}};
}

}  // namespace space::live
