/// @file
/// The pages that nobody writes by hand: chapter table, exercises, figures, claims, and the menu.
#pragma once

#include "docs/figures.hpp"
#include "docs/ledger.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace space::docs {

/// Writes *.dox, texts/, layout.xml and images/ into places.pages.
/// @throws Error (bad_input) for a malformed list, exercise or results file, (bad_output)
void write_pages(const Places& places);

/// Settings for Doxygen: \\fig_01_03 in a page stands for that figure with its number and its
/// caption, both from the register of figures; for a sentence where the figure has no file.
std::string figure_aliases(const Places& places);

/// The chapter's .dox files as the menu lists them: chapter.dox, then the others in the order in
/// which that names their pages. @pre chapter.dox is there
std::vector<std::filesystem::path> text_files(const std::filesystem::path& root,
                                              const Chapter& chapter);

/// Figures of a chapter are numbered from 1 in the order in which its text shows them: what is
/// wrong with that, or nothing. A figure that is shown again counts where it is shown first.
std::string figure_order_fault(int chapter, const std::string& text);

/// A list for a page, from the ledger: of the claims with the verdict `which`, each linked to its
/// card; or, for "tally", of how many claims of each source have which verdict (of a claim with two
/// answers the later one counts, as in the ledger's head). @throws Error (bad_input) for another
/// word
std::string claims_table(const std::vector<ClaimVerdict>& verdicts, const std::string& which);

/// The table "| Read | for |" of a chapter's README.md for the chapter's page: names in place of
/// links, and without the row of the page itself. @throws Error (bad_input) where there is none, or
/// no file that it links to
std::string files_table(const std::filesystem::path& readme);

}  // namespace space::docs
