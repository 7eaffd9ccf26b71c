/// @file
/// The text that the site's search looks through: one entry per section of a page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace space::docs {

/// A section of a page, or a member of a class or file.
struct SearchEntry {
    std::string page;   ///< "1. Naive ray tracing"
    std::string title;  ///< of the section; the page's own for what stands before the first
    std::string url;    ///< "ch01_naive_ray_tracing.html#ch01_idea"
    std::string text;
};

/// The entries of one of Doxygen's HTML pages.
std::vector<SearchEntry> search_entries(const std::string& page, const std::string& file_name);

/// Writes search_text.js: the entries of all pages but lists and source code.
void write_search_text(const std::filesystem::path& site);

}  // namespace space::docs
