#include "common/program/results.hpp"

#include "common/program/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace space {

std::string_view name(Verdict verdict) {
    switch (verdict) {
        case Verdict::confirmed:
            return "confirmed";
        case Verdict::refuted:
            return "refuted";
        case Verdict::depends:
            return "depends";
    }
    return "";
}

Verdict verdict_of(std::size_t agree, std::size_t all) {
    return agree == all ? Verdict::confirmed : agree == 0 ? Verdict::refuted : Verdict::depends;
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

void write_results(const std::filesystem::path& file, const Results& results) {
    nlohmann::ordered_json answers = nlohmann::ordered_json::array();
    for (const ClaimAnswer& answer : results.answers)
        answers.push_back({{"claim", answer.claim},
                           {"verdict", name(answer.verdict)},
                           {"measured", answer.measured},
                           {"scene", answer.scene},
                           {"rule", answer.rule}});
    nlohmann::ordered_json document = results.run;
    document["answers"] = answers;
    write_file(file, document.dump(2) + '\n');
}

}  // namespace space
