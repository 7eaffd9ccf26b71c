/// @file
/// What chapters' texts quote from their runs: \num, \table and \measured, put in before Doxygen
/// reads them.
#pragma once

#include "common/program/provenance.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace space::docs {

/// One numbers.json with the tables beside it.
struct MeasuredRun {
    Provenance run;
    std::map<std::string, std::string> numbers, tables;  ///< texts and Markdown by name
};
/// `tables_as` begins the tables' file names, such as "ch03_". @throws Error (bad_input)
MeasuredRun read_measured(const std::filesystem::path& file, const std::string& tables_as);

/// In what run something was measured, and whether it still stands: one sentence or two, HTML.
/// @param now the sources' fingerprints as they are
std::string told(const Provenance& run, const Fingerprints& now);

/// The numbers of every chapter: those of the committed run, and over them those of the reader's
/// own, if it is newer and measures times.
class Measured {
  public:
    Measured(std::filesystem::path root, std::filesystem::path runs)
        : root_(std::move(root)), runs_(std::move(runs)) {}

    /// The text of a page with
    /// \num{ch03.deepest} as the number of that name in chapter 3's numbers,
    /// \table{ch03.splitters} as that table, and
    /// \measured{ch03} as what told() says of the run.
    /// @param name of the page, for errors
    /// @throws Error (bad_input) naming page, line and what is not known
    std::string resolved(const std::string& text, const std::string& name);

  private:
    struct Chapter {
        MeasuredRun committed, own;  ///< own.run.mode is empty where there is none
    };
    const Chapter& chapter(const std::string& name);

    std::filesystem::path root_, runs_;
    std::map<std::string, Chapter> chapters_;
};

}  // namespace space::docs
