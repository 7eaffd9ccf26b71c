#include "docs/ledger.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace space::docs {
namespace {

/// Parses a file and hands the document to `read`; a fault of the format becomes one line that
/// names the file.
template <class Read>
auto read_json(const std::filesystem::path& file, const Read& read) {
    try {
        return read(nlohmann::json::parse(read_file(file)));
    } catch (const nlohmann::json::exception& fault) {
        throw input_error(fmt::format("{}: {}", file.string(), fault.what()));
    }
}

}  // namespace

std::vector<Chapter> read_chapters(const std::filesystem::path& root) {
    return read_json(root / "docs/chapters.json", [&](const nlohmann::json& document) {
        std::vector<Chapter> chapters;
        for (const auto& entry : document) {
            const std::string folder = entry.at("folder"), begun = entry.value("begun", "");
            const auto dir = root / "chapters" / folder;
            chapters.push_back(
                {.number = static_cast<int>(chapters.size()) + 1,
                 .folder = folder,
                 .title = entry.at("title"),
                 .teaches = entry.at("teaches"),
                 .sources = entry.at("sources"),
                 .begun = begun,
                 .here = begun.empty() && exists(dir / "chapter.dox") && exists(dir / "main.cpp")});
        }
        return chapters;
    });
}

std::vector<Claim> read_claims(const std::filesystem::path& file) {
    return read_json(file, [](const nlohmann::json& document) {
        std::vector<Claim> claims;
        for (const auto& entry : document)
            claims.push_back({.id = entry.at("id"),
                              .source = entry.at("source"),
                              .note = entry.value("note", ""),
                              .text = entry.at("claim"),
                              .chapters = entry.at("chapters"),
                              .how = entry.value("how", "")});
        return claims;
    });
}

Answers read_answers(const std::filesystem::path& file) {
    return read_json(file, [](const nlohmann::json& document) {
        Answers result{.run = document.get<Provenance>(), .answers = {}};
        for (const auto& entry : document.at("answers"))
            result.answers.push_back({.claim = entry.at("claim"),
                                      .verdict = entry.at("verdict"),
                                      .measured = entry.at("measured"),
                                      .scene = entry.at("scene"),
                                      .rule = entry.at("rule")});
        return result;
    });
}

std::vector<std::string> faults(const std::vector<Claim>& claims, int chapter,
                                const Answers& answers) {
    std::vector<std::string> lines;
    for (const Claim& claim : claims) {
        if (std::ranges::find(claim.chapters, chapter) == claim.chapters.end()) continue;
        const auto count = std::ranges::count(answers.answers, claim.id, &Answer::claim);
        if (count == 0)
            lines.push_back(fmt::format("claim {} has no answer: {}", claim.id, claim.text));
        if (count > 1)
            lines.push_back(fmt::format("claim {} is answered {} times", claim.id, count));
    }
    for (const Answer& answer : answers.answers) {
        const auto claim = std::ranges::find(claims, answer.claim, &Claim::id);
        if (claim == claims.end())
            lines.push_back(
                fmt::format("answer to {}: no source makes a claim of that id", answer.claim));
        else if (std::ranges::find(claim->chapters, chapter) == claim->chapters.end())
            lines.push_back(fmt::format("answer to {}: that claim belongs to chapter {}",
                                        answer.claim, fmt::join(claim->chapters, ", ")));
        constexpr std::array verdicts{"confirmed", "refuted", "depends"};
        if (std::ranges::find(verdicts, answer.verdict) == verdicts.end())
            lines.push_back(
                fmt::format("answer to {}: \"{}\" is no verdict", answer.claim, answer.verdict));
        for (const auto& [field, value] : {std::pair{"measured", &answer.measured},
                                           {"scene", &answer.scene},
                                           {"rule", &answer.rule}})
            if (value->find_first_not_of(" \t\n") == std::string::npos)
                lines.push_back(fmt::format("answer to {}: \"{}\" is empty", answer.claim, field));
    }
    return lines;
}

std::filesystem::path newest_results(const std::filesystem::path& root,
                                     const std::filesystem::path& runs, int chapter) {
    const auto committed = root / fmt::format("figures/measured/ch{:02}_results.json", chapter);
    const auto own = runs / fmt::format("ch{:02}/results.json", chapter);
    const std::string mode = exists(own) ? read_answers(own).run.mode : "";
    const bool own_counts = mode == "full" || mode == "quick";  // --small has no times
    if (!exists(committed)) return own_counts ? own : std::filesystem::path{};
    return own_counts && last_write_time(own) > last_write_time(committed) ? own : committed;
}

std::vector<ClaimVerdict> read_verdicts(const std::filesystem::path& root,
                                        const std::filesystem::path& runs) {
    const std::vector<Claim> claims = read_claims(root / "docs/claims.json");
    std::vector<ClaimVerdict> verdicts;
    for (const Chapter& chapter : read_chapters(root)) {
        if (!chapter.here) continue;
        Answers answers;
        if (const auto file = newest_results(root, runs, chapter.number); !file.empty())
            answers = read_answers(file);
        for (const Claim& claim : claims) {
            if (std::ranges::find(claim.chapters, chapter.number) == claim.chapters.end()) continue;
            const auto answer = std::ranges::find(answers.answers, claim.id, &Answer::claim);
            verdicts.push_back({.claim = claim,
                                .chapter = chapter.number,
                                .verdict = answer == answers.answers.end() ? "" : answer->verdict});
        }
    }
    return verdicts;
}

}  // namespace space::docs
