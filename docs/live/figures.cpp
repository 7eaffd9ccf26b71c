#include "docs/live/live.hpp"

namespace space::live {

Answer build_methods(const State& state);
Answer build_steps(const State& state);
Answer bvh_walk(const State& state);
Answer placing(const State& state);
Answer placing_orders(const State& state);
Answer rotations(const State& state);
Answer shared_edge(const State& state);

std::span<const LiveFigure> live_figures() {
    static constexpr std::array all{LiveFigure{"fig_02_02", shared_edge},
                                    LiveFigure{"fig_07_17", bvh_walk},
                                    LiveFigure{"fig_08_11", build_methods},
                                    LiveFigure{"fig_08_15", build_steps},
                                    LiveFigure{"fig_09_04", placing},
                                    LiveFigure{"fig_09_05", placing_orders},
                                    LiveFigure{"fig_09_17", rotations}};
    return all;
}

}  // namespace space::live
