/// @file
/// The book's figures as the pages and the slides show them: from the register that CMake writes,
/// each with its newest picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace space::docs {

/// Where things are.
struct Places {
    std::filesystem::path root;        ///< the project
    std::filesystem::path configured;  ///< the build directory, with figures.json and exercises.txt
    std::filesystem::path runs;        ///< what ./book run wrote, chNN/..., if it did
    std::filesystem::path pages;       ///< where the generated pages go
};

/// A figure of the list that CMake writes.
struct Figure {
    std::string id, chapter, kind, caption;
    std::filesystem::path file;  ///< the newest picture of it; empty where there is none
};

/// All of them, by id, which is the order of the text. @throws Error (bad_input) for a malformed
/// list
std::vector<Figure> read_figures(const Places& places);

/// "svg", or "png" for a rendering.
const char* extension_of(const Figure& figure);

/// "3.4", as the text has it and ./book figures takes it.
std::string number_of(const Figure& figure);

}  // namespace space::docs
