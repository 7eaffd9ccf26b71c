/// What the page about the advice quotes.
#include "chapters/ch12_comparison/measured/advice_data.hpp"
#include "chapters/ch12_comparison/measured/advice_fit.hpp"
#include "common/program/numbers.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch12 {
namespace {

std::string power_name(double rays) {
    return fmt::format("10<sup>{:.0f}</sup>", std::log10(rays));
}

Table method_table(std::span<const AdviceMethod> methods, std::string_view heading) {
    Table table({std::string(heading), "", "questions", "within 1.15", "share", "mean", "worst"});
    for (const AdviceMethod& m : methods)
        table.row({m.name, m.about, with_commas(m.cases), with_commas(m.good), percent(m.share()),
                   fixed(m.mean_ratio, 2), fixed(m.worst_ratio, 2)});
    return table;
}

Table miss_table(std::span<const AdviceCase> cases) {
    std::vector<AdviceCase> misses;
    std::ranges::copy_if(cases, std::back_inserter(misses),
                         [](const AdviceCase& c) { return !c.is_good(); });
    std::ranges::stable_sort(misses, std::greater{}, &AdviceCase::ratio);
    Table table({"scene", "rays", "advised", "best in hindsight", "times the best"});
    for (const AdviceCase& c : misses)
        table.row({c.spec, power_name(c.rays), c.advised, c.best, fixed(c.ratio(), 2)});
    return table;
}

/// For each number of rays what was advised how often, and how often that was good.
Table advice_by_rays(std::span<const AdviceCase> cases) {
    std::map<double, std::vector<AdviceCase>> by_rays;
    for (const AdviceCase& c : cases) by_rays[c.rays].push_back(c);
    Table table({"rays", "advised", "good", "of"});
    for (const auto& [rays, asked] : by_rays) {
        std::map<std::string, std::size_t> times;
        for (const AdviceCase& c : asked) ++times[c.advised];
        std::vector<std::pair<std::string, std::size_t>> names(times.begin(), times.end());
        std::ranges::stable_sort(names, std::greater{},
                                 &std::pair<std::string, std::size_t>::second);
        std::string text;
        for (const auto& [name, count] : names)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
        table.row({power_name(rays), text,
                   with_commas(static_cast<std::uint64_t>(
                       std::ranges::count_if(asked, &AdviceCase::is_good))),
                   with_commas(asked.size())});
    }
    return table;
}

Table seen_table(std::span<const SeenScene> scenes) {
    std::vector<std::string> headings{"scene", "triangles"};
    for (const std::string_view name : feature_names) headings.emplace_back(name);
    headings.emplace_back("used to");
    Table table(headings);
    for (const SeenScene& scene : scenes) {
        std::vector<std::string> cells{scene.spec, with_commas(scene.triangles)};
        for (const double value : scene.features) cells.push_back(fixed(value, 2));
        cells.emplace_back(scene.is_fitted ? "fit" : "judge");
        table.row(cells);
    }
    return table;
}

const AdviceMethod& method_named(const JudgedAdvice& judged, std::string_view name) {
    return *std::ranges::find(judged.methods, name, &AdviceMethod::name);
}

}  // namespace

void quote_advice(const JudgedAdvice& judged, Numbers& numbers) {
    if (judged.methods.empty()) return;
    std::vector<AdviceCase> unseen = judged.other_half;
    unseen.insert(unseen.end(), judged.fetched.begin(), judged.fetched.end());
    const std::pair<const char*, const std::vector<AdviceCase>*> parts[] = {
        {"fitted", &judged.fitted},
        {"other", &judged.other_half},
        {"fetched", &judged.fetched},
        {"unseen", &unseen}};
    const char* const about[] = {"the half that the model was fitted on",
                                 "the other half of the made scenes", "scenes from files",
                                 "both that it had not seen"};
    std::vector<AdviceMethod> summaries;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& [name, cases] = parts[i];
        const AdviceMethod m = summary_of_cases(name, about[i], *cases);
        if (!cases->empty()) summaries.push_back(m);
        const auto number = [&](const char* what, double value, const std::string& text) {
            const bool is_known = !cases->empty();  // there may be no scene from a file
            numbers.time(fmt::format("advice_{}_{}", name, what), is_known ? value : 0.0,
                         is_known ? text : "–");
        };
        number("questions", static_cast<double>(m.cases), with_commas(m.cases));
        number("good", static_cast<double>(m.good), with_commas(m.good));
        number("share", m.share(), percent(m.share()));
        number("mean", m.mean_ratio, fixed(m.mean_ratio, 2));
        number("worst", m.worst_ratio, fixed(m.worst_ratio, 2));
    }
    for (const auto& [name, method] :
         {std::pair("one", "one for all"), {"count", "count"}, {"neighbours", "neighbours"}}) {
        const double share = method_named(judged, method).share();
        numbers.time(fmt::format("advice_{}_share", name), share, percent(share));
    }
    const AdviceMethod& chosen = judged.methods[judged.chosen];
    numbers.time("advice_chosen", 0.0, chosen.name);
    numbers.time("advice_chosen_share", chosen.share(), percent(chosen.share()));
    const auto fitted = static_cast<std::size_t>(
        std::ranges::count_if(judged.scenes, [](const SeenScene& s) { return s.is_fitted; }));
    numbers.time("advice_fitted_scenes", static_cast<double>(fitted), with_commas(fitted));
    numbers.time("advice_look_ms", judged.look_ms, fixed(judged.look_ms, 0));
    numbers.time_table("advice_methods", method_table(judged.methods, "way"));
    numbers.time_table("advice_judged", method_table(summaries, "part"));
    numbers.time_table("advice_misses", miss_table(unseen));
    numbers.time_table("advice_by_rays", advice_by_rays(unseen));
    numbers.time_table("advice_scenes", seen_table(judged.scenes));
}

}  // namespace space::ch12
