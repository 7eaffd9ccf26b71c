/// @file
/// How much is measured: for tests, for a look, for the book.
#pragma once

#include "common/program/options.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace space::ch10 {

/// A scene, and whether its triangles are as long as itself.
struct FastScene {
    std::string name;
    bool is_long = false;
};

/// By the options' amount. rounds = 0: nothing is timed.
struct FastEffort {
    int width = 256, height = 192, rounds = 3;
    int mode_width = 512, mode_height = 384;  ///< packets hang on how many pixels a triangle has
    std::vector<FastScene> scenes;            ///< beside Embree
    std::vector<FastScene> ladder;            ///< a small one, a large one, one of long triangles
    std::vector<FastScene> modes;
    std::vector<std::string> sizes;  ///< one scene as it grows
    std::vector<std::string> aimed;  ///< small enough for the naive loop
    std::size_t aimed_rays = 50'000;
    std::size_t most_high = 400'000;  ///< triangles over which better trees are built
};

inline FastEffort fast_effort(const Options& options) {
    FastEffort effort;
    effort.scenes = {{"bunny"},        {"dragon_871k"},  {"conference", true}, {"forest"},
                     {"room:3", true}, {"stadium"},      {"icosphere:300"},    {"soup:1000000"},
                     {"mount:10"},     {"slivers", true}};
    effort.ladder = {{"stadium"}, {"icosphere:300"}, {"building", true}};
    effort.modes = {{"stadium"}, {"bunny"}, {"dragon_871k"}, {"icosphere:300"}, {"soup:1000000"}};
    effort.sizes = {"soup:1000",   "soup:3162",   "soup:10000",   "soup:31623",
                    "soup:100000", "soup:316228", "soup:1000000", "soup:2000000"};
    effort.aimed = {"icosphere:8", "lattice:1", "slivers"};
    if (options.amount() == Amount::quick) {
        effort.width = 160, effort.height = 120;
        effort.mode_width = 320, effort.mode_height = 240;
        effort.scenes = {{"stadium"}, {"icosphere:40"}, {"soup:30000"}, {"building", true}};
        effort.ladder = {{"stadium"}, {"icosphere:70"}, {"building", true}};
        effort.modes = {{"stadium"}, {"icosphere:70"}};
        effort.sizes = {"soup:1000", "soup:10000", "soup:100000"};
        effort.aimed_rays = 30'000;
    }
    if (options.small) {
        effort.width = 32, effort.height = 24;
        effort.mode_width = 32, effort.mode_height = 24;
        effort.scenes = {{"soup:1000"}, {"slivers:300", true}};
        effort.ladder = {{"stadium:2"}, {"icosphere:20"}, {"slivers:300", true}};
        effort.modes = {{"stadium:2"}};
        effort.sizes = {"soup:300", "soup:1000"};
        effort.aimed = {"icosphere:4"};
        effort.aimed_rays = 2'000;
    }
    if (options.counts && options.quick)  // what takes seconds
        effort.aimed = {"icosphere:4"}, effort.aimed_rays = 2'000;
    if (options.small || options.counts) effort.rounds = 0;
    return effort;
}

}  // namespace space::ch10
