/// @file
/// Figures for the lecture room: a web page that shows one at a time, with its steps and its
/// caption, and needs no other file.
#pragma once

#include "docs/figures.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace space::docs {

/// Colours of the slides: those of the reader's system, or always the same.
enum class SlideMode { system, light, dark };

/// The page: an outline with the title, then the figures in their order. Its style and its script
/// are those in root/docs. @throws Error (bad_input) where a figure has no picture
std::string slides(std::string_view title, const std::vector<Figure>& figures,
                   const std::filesystem::path& root, SlideMode mode = SlideMode::system);

/// What a file of slides shows.
struct SlideShow {
    std::string file, title;  ///< "slides_07.html", "Chapter 7: Bounding volume hierarchies"
    std::vector<Figure> figures;
};

/// One for each chapter that is named ("ch07_bounding_volume_hierarchies"), and one for all figures
/// that are (fig_07_16), in the order in which they are named, each once; of nothing named, one for
/// each chapter that has figures. @throws Error (usage) for a name of neither
std::vector<SlideShow> slide_shows(const Places& places, const std::vector<std::string>& named);

}  // namespace space::docs
