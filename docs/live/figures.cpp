#include "docs/live/live.hpp"

namespace space::live {

Answer bsp_build(const State& state);
Answer bsp_walk(const State& state);
Answer build_methods(const State& state);
Answer build_steps(const State& state);
Answer bvh_walk(const State& state);
Answer kd_build(const State& state);
Answer lazy_rays(const State& state);
Answer morton_curve(const State& state);
Answer placing(const State& state);
Answer placing_orders(const State& state);
Answer plane_costs(const State& state);
Answer point_searches(const State& state);
Answer quadtree_points(const State& state);
Answer refits(const State& state);
Answer rotations(const State& state);
Answer shared_edge(const State& state);
Answer turned_mesh(const State& state);

std::span<const LiveFigure> live_figures() {
    static constexpr std::array all{
        LiveFigure{"fig_02_02", shared_edge},     LiveFigure{"fig_03_13", bsp_build},
        LiveFigure{"fig_03_14", bsp_walk},        LiveFigure{"fig_04_05", plane_costs},
        LiveFigure{"fig_04_12", point_searches},  LiveFigure{"fig_04_14", kd_build},
        LiveFigure{"fig_05_02", lazy_rays},       LiveFigure{"fig_06_09", morton_curve},
        LiveFigure{"fig_06_15", quadtree_points}, LiveFigure{"fig_07_17", bvh_walk},
        LiveFigure{"fig_08_11", build_methods},   LiveFigure{"fig_08_15", build_steps},
        LiveFigure{"fig_09_04", placing},         LiveFigure{"fig_09_05", placing_orders},
        LiveFigure{"fig_09_17", rotations},       LiveFigure{"fig_09_19", refits},
        LiveFigure{"fig_12_14", turned_mesh},
    };
    return all;
}

}  // namespace space::live
