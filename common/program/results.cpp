#include "common/program/results.hpp"

#include "common/program/file.hpp"

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
