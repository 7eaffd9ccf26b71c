/// @file
/// What Doxygen leaves to do on its HTML files: drawings become part of the page, quoted code
/// starts at the margin, links lead somewhere.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace space::docs {

/// An SVG file as a part of a page, whose colours reach it there; after one with steps
/// (Svg::begin_step) comes the list of what they tell, which steps.js makes into a step-through.
/// @throws Error (bad_input) where the picture is missing
std::string whole_drawing(const std::filesystem::path& file);

/// Puts the SVG files that the page shows into the page itself.
/// @throws Error (bad_input) where a picture is missing or two pictures of the page share an
/// element's id
std::string inline_drawings(const std::string& page, const std::filesystem::path& folder);

/// Quoted code loses the indentation that all of its lines share.
std::string dedent_fragments(const std::string& page);

/// Links in code that rest on a word's spelling alone go.
std::string without_guesses(const std::string& page);

/// No line ends inside an option such as --query or a folder of a path, nor between a formula and
/// the full stop behind it.
std::string kept_together(const std::string& page);

/// A picture's caption is its text for those who don't see it.
std::string with_alternatives(const std::string& page);

/// A table's first row is its head, which stands again on each sheet that the table reaches.
std::string with_table_heads(const std::string& page);

/// The book's pages as links, for readers without scripts; Doxygen makes its menu by one, from
/// navtreedata.js.
std::string menu_without_scripts(const std::string& navigation);

/// The line of links to the parts of a page of the code goes: some lead nowhere (Doxygen 1.9.4,
/// private classes).
std::string without_summary(const std::string& page);

/// Drawings that have a live twin of the same id (docs/live) are marked, and a page that has any
/// loads what plays them.
std::string with_live_figures(std::string page, std::span<const std::string> live);

/// All of these, on every page of the site.
void finish_pages(const std::filesystem::path& site, std::span<const std::string> live);

}  // namespace space::docs
