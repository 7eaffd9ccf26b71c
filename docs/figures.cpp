#include "docs/figures.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace space::docs {
namespace {

namespace fs = std::filesystem;

/// Figures of a folder named chNN: the reader's own run where it is newer than what is committed.
fs::path newest_figure(const Places& places, const Figure& figure) {
    const std::string name = fmt::format("{}.{}", figure.id, extension_of(figure));
    const fs::path own = places.runs / figure.chapter.substr(0, 4) / name;
    for (const fs::path& committed :
         {places.root / "figures" / name, places.root / "figures/measured" / name})
        if (exists(committed))
            return exists(own) && last_write_time(own) > last_write_time(committed) ? own
                                                                                    : committed;
    return exists(own) ? own : fs::path{};
}

}  // namespace

const char* extension_of(const Figure& figure) {
    return figure.kind == "rendering" ? "png" : "svg";
}

std::string number_of(const Figure& figure) {
    return fmt::format("{}.{}", std::stoi(figure.id.substr(4, 2)), std::stoi(figure.id.substr(7)));
}

std::vector<Figure> read_figures(const Places& places) {
    const fs::path list = places.configured / "figures.json";
    std::vector<Figure> figures;
    try {
        for (const auto& entry : nlohmann::json::parse(read_file(list))) {
            Figure figure{.id = entry.at("id"),
                          .chapter = entry.at("chapter"),
                          .kind = entry.at("kind"),
                          .caption = entry.at("caption"),
                          .file = {}};
            figure.file = newest_figure(places, figure);
            figures.push_back(std::move(figure));
        }
    } catch (const nlohmann::json::exception& fault) {
        throw input_error(fmt::format("{}: {}", list.string(), fault.what()));
    }
    std::ranges::sort(figures, {}, &Figure::id);
    return figures;
}

}  // namespace space::docs
