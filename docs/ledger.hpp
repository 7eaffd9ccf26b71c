/// @file
/// The ledger of claims: what the sources say (docs/claims.json), and what the chapters' programs
/// measured.
#pragma once

#include "common/program/provenance.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace space::docs {

/// One of the twelve chapters, planned or here.
struct Chapter {
    int number;
    std::string folder;  ///< "ch01_naive_ray_tracing"; also the id of its page
    std::string title, teaches;
    std::vector<std::string> sources;
    std::string begun;  ///< what stands of a chapter that is to come: it has a page, but owes no
                        ///< answers yet
    bool here;          ///< its text and its program stand
};

/// A claim that a source makes, as listed in claims.json.
struct Claim {
    std::string id, source;
    std::string note;  ///< "erratum", "table 2", "after Havran 2001", or nothing
    std::string text;
    std::vector<int> chapters;  ///< each of them owes an answer
    std::string how;            ///< "simulated past this machine's cores", or nothing
};

/// What a program answered; its fields are those of common/program/results.hpp.
struct Answer {
    std::string claim, verdict, measured, scene, rule;
};

/// One results file.
struct Answers {
    Provenance run;
    std::vector<Answer> answers;
};

/// @throws Error (bad_input) naming the file and the fault
std::vector<Chapter> read_chapters(const std::filesystem::path& root);
std::vector<Claim> read_claims(const std::filesystem::path& file);
Answers read_answers(const std::filesystem::path& file);

/// What is wrong with a chapter's answers, a line each: a claim of the chapter without an answer or
/// with two, an answer to a claim of no such id or of another chapter, a verdict that is none of
/// the three, an empty field.
std::vector<std::string> faults(const std::vector<Claim>& claims, int chapter,
                                const Answers& answers);

/// The newer of two results files that are there: the committed one (figures/measured) and that of
/// the reader's own full run (runs/chNN/results.json). Empty where there is none.
std::filesystem::path newest_results(const std::filesystem::path& root,
                                     const std::filesystem::path& runs, int chapter);

/// What one chapter's program answered to a claim.
struct ClaimVerdict {
    Claim claim;
    int chapter;
    std::string verdict;  ///< empty where there is no answer yet
};

/// The claims of all chapters that are here, chapter after chapter, with the newest verdicts.
std::vector<ClaimVerdict> read_verdicts(const std::filesystem::path& root,
                                        const std::filesystem::path& runs);

}  // namespace space::docs
