#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "chapters/ch12_comparison/measured/comparison_tables.hpp"
#include "chapters/ch12_comparison/measured/comparison_views.hpp"
#include "common/measure.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch12 {
namespace {

/// Numbers of one comparison. What a smaller run does not know stands as a dash.
class Quoted {
  public:
    Quoted(const Comparison& comparison, Numbers& numbers)
        : comparison_(comparison),
          large_(blocks_near(comparison, compared_size(comparison))),
          numbers_(numbers) {}

    void all() {
        sizes();
        answers();
        best();
        pairs();
        noise();
        worth();
        growths();
    }

  private:
    void whole(const char* name, std::uint64_t value) {
        numbers_.time(name, double(value), with_commas(value));
    }
    void factor(const char* name, double value, int digits = 2) {
        const bool known = std::isfinite(value);
        numbers_.time(name, known ? value : 0.0, known ? fixed(value, digits) : "–");
    }
    void word(const std::string& name, double value, const std::string& text) {
        numbers_.time(name, value, text);
    }
    /// A number of rays, in a power of ten with one digit.
    void rays(const char* name, std::vector<double> values) {
        const double middle = values.empty() ? 0.0 : median(std::move(values));
        numbers_.time(name, middle, middle > 0.0 ? rays_text(middle) : "–");
    }
    static std::string rays_text(double rays) {
        return rays < 1e4 ? with_commas(std::uint64_t(rays)) : power_of_ten(rays);
    }

    void sizes() {
        std::set<std::string> scenes, structures;
        std::uint64_t rows = 0, rays = 0, largest = 0;
        for (const ComparedRow& row : comparison_.rows) {
            scenes.insert(row.scene);
            structures.insert(row.structure);
            rows += row.stands();
            if (!row.is_peer) rays += row.rays();
            largest = std::max(largest, row.triangles);
        }
        whole("scenes", scenes.size());
        whole("structures", structures.size());
        whole("rows", rows);
        whole("rays", rays);
        whole("rays_each", comparison_.rows.empty() ? 0 : most_rays_of_a_kind());
        whole("largest", largest);
        whole("large_scenes", large_.size());
        factor("run_minutes", comparison_.minutes, 1);
    }
    std::uint64_t most_rays_of_a_kind() const {
        std::uint64_t most = 0;
        for (const ComparedRow& row : comparison_.rows)
            most = std::max(most, row[RayKind::camera].rays);
        return most;
    }

    void answers() {
        whole("wrong_ours", wrong_answers(comparison_));
        whole("wrong_peers", wrong_answers(comparison_, true));
    }

    /// Who is fastest for diffuse rays, and by how much.
    void best() {
        std::map<std::string, std::uint64_t> wins;
        std::vector<double> spreads;
        for (const Block block : large_) {
            auto sorted = by_ray_cost(block, RayKind::diffuse);
            std::erase_if(sorted, [](auto* row) { return row->structure == "naive"; });
            if (sorted.size() < 2) continue;
            ++wins[sorted.front()->structure];
            spreads.push_back(ray_cost(*sorted.back(), RayKind::diffuse) /
                              ray_cost(*sorted.front(), RayKind::diffuse));
        }
        const auto most =
            std::ranges::max_element(wins, {}, [](const auto& entry) { return entry.second; });
        const bool known = most != wins.end();
        word("best_most_often", known ? double(most->second) : 0.0, known ? most->first : "–");
        whole("best_most_often_scenes", known ? most->second : 0);
        factor("spread_least", spreads.empty() ? unknown : std::ranges::min(spreads), 1);
        factor("spread_most", spreads.empty() ? unknown : std::ranges::max(spreads), 1);
        const auto fast = factors(large_, "fast", RayKind::diffuse);
        factor("fast_median_beside_best", median_factor(fast));
        factor("fast_worst_beside_best", fast.empty() ? unknown : worst(fast).factor);
        word("fast_worst_scene", 0.0, fast.empty() ? "–" : worst(fast).scene);
        factor("embree_beside_best", median_factor(factors(large_, "embree", RayKind::diffuse)));
    }

    void ratio(const char* name, std::string_view structure, std::string_view other) {
        factor(name, median_factor(ratios(large_, structure, other, RayKind::diffuse)));
    }
    /// The same at a tenth of that size, where more structures stand.
    void ratio_of_middle(const char* name, std::string_view structure, std::string_view other) {
        const std::vector<Block> middle = blocks_near(comparison_, compared_size(comparison_) / 10);
        factor(name, median_factor(ratios(middle, structure, other, RayKind::diffuse)));
    }
    void pairs() {
        std::map<bool, std::vector<double>> by_evenness;
        std::uint64_t octree_wins = 0;
        const auto duels = octree_duels(comparison_);
        for (const OctreeDuel& duel : duels) {
            by_evenness[duel.is_even].push_back(duel.ratio());
            octree_wins += duel.ratio() < 1.0;
        }
        factor("bvh_over_octree_even", median(by_evenness[true]));
        factor("bvh_over_octree_uneven", median(by_evenness[false]));
        word("octree_wins", double(octree_wins),
             fmt::format("{} of {}", octree_wins, duels.size()));
        ratio("median_over_middle", "bvh-median", "bvh-middle");
        ratio_of_middle("kd_median_over_middle", "kd-median", "kd-middle");
        ratio("kd_over_bvh", "kd-sah", "bvh-binned");
        ratio_of_middle("kd_median_over_sah", "kd-median", "kd-sah");
        ratio("bvh_median_over_binned", "bvh-median", "bvh-binned");
        ratio("scalar_over_binned", "fast-scalar", "bvh-binned");
        ratio("bottom_up_over_sweep", "bvh-bottom-up", "bvh-sweep");
        ratio("optimised_over_spatial", "bvh-optimised", "bvh-spatial");
        ratio_of_middle("bsp_over_kd", "bsp", "kd-sah");
        std::vector<double> builds;
        for (const Block block : large_) {
            const ComparedRow *const kd = find(block, "kd-sah"), *const bvh =
                                                                     find(block, "bvh-binned");
            if (kd && bvh) builds.push_back(kd->build_ms / bvh->build_ms);
        }
        factor("kd_build_over_bvh", median(std::move(builds)), 1);
    }

    /// bvh-parallel makes the tree of bvh-binned, and each is timed by itself: what lies between
    /// their rays is noise.
    void noise() {
        std::vector<double> twins;
        std::uint64_t apart = 0;
        for (const Block block : blocks(comparison_)) {
            const ComparedRow *const one = find(block, "bvh-binned"), *const other = find(
                                                                          block, "bvh-parallel");
            if (!one || !other || !(one->mean_ns() > 0.0)) continue;
            const double ratio = other->mean_ns() / one->mean_ns();
            twins.push_back(ratio);
            apart += std::max(ratio, 1.0 / ratio) > 1.15;
        }
        word("noise_apart", double(apart), fmt::format("{} of {}", apart, twins.size()));
        factor("noise_least", twins.empty() ? unknown : std::ranges::min(twins));
        factor("noise_most", twins.empty() ? unknown : std::ranges::max(twins));
    }

    /// What is worth its build.
    void worth() {
        std::vector<double> naive_until, hq_from;
        for (const Block block : smallest_blocks(comparison_))
            if (const auto range = worth_it(block, "naive")) naive_until.push_back(range->second);
        rays("naive_until", std::move(naive_until));
        std::uint64_t lazy = 0, morton = 0;
        std::vector<std::string> never = structure_names(comparison_, false);
        for (const Block block : large_) {
            if (const auto range = worth_it(block, "fast-hq")) hq_from.push_back(range->first);
            lazy += worth_it(block, "kd-lazy").has_value();
            morton += worth_it(block, "bvh-morton") || worth_it(block, "bvh-parallel-morton");
            std::erase_if(
                never, [&](const std::string& name) { return worth_it(block, name).has_value(); });
        }
        rays("hq_from", std::move(hq_from));
        const auto of_all = [&](const char* name, std::uint64_t count) {
            word(name, double(count), fmt::format("{} of {}", count, large_.size()));
        };
        of_all("lazy_scenes", lazy);
        of_all("morton_scenes", morton);
        whole("never_cheapest", never.size());
        word("never_cheapest_names", 0.0, fmt::format("{}", fmt::join(never, ", ")));
    }

    void growths() {
        std::vector<double> builds, nodes;
        for (const std::string& name : structure_names(comparison_, false)) {
            const Growth grown = growth(comparison_, name);
            // Naive tracing has no build, and a lazy tree's is that of its rays.
            if (name == "naive" || name == "kd-lazy") continue;
            if (!grown.build.empty()) builds.push_back(median(grown.build));
            if (!grown.nodes.empty()) nodes.push_back(median(grown.nodes));
        }
        const auto ends = [&](const char* least, const char* most, std::vector<double> values) {
            factor(least, values.empty() ? unknown : std::ranges::min(values));
            factor(most, values.empty() ? unknown : std::ranges::max(values));
        };
        ends("growth_build_least", "growth_build_most", builds);
        ends("growth_nodes_least", "growth_nodes_most", nodes);
    }

    const Comparison& comparison_;
    std::vector<Block> large_;
    Numbers& numbers_;
};

}  // namespace

void quote_comparison(const Comparison& comparison, bool times, Numbers& numbers) {
    quote_tables(comparison, times, numbers);
    if (times) Quoted(comparison, numbers).all();
}

}  // namespace space::ch12
