#include "docs/live/live.hpp"

namespace space::live {

Answer bvh_walk(const State& state);
Answer shared_edge(const State& state);

std::span<const LiveFigure> live_figures() {
    static constexpr std::array all{LiveFigure{"fig_02_02", shared_edge},
                                    LiveFigure{"fig_07_17", bvh_walk}};
    return all;
}

}  // namespace space::live
