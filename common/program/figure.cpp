#include "common/program/figure.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>

namespace space {
namespace {

void write(const std::filesystem::path& out, std::string_view id, const Svg& drawing) {
    write_file(out / fmt::format("{}.svg", id), drawing.document(id));
}

void write(const std::filesystem::path& out, std::string_view id, const Image& rendering) {
    write_png(out / fmt::format("{}.png", id), rendering);
}

void write(const std::filesystem::path& out, std::string_view id, Chart chart) {
    chart.id = id;
    write_chart(out, chart);
}

}  // namespace

void write_figure(const Figure& figure, const Options& options) {
    std::visit([&](const auto make) { write(options.out, figure.id, make(options)); }, figure.make);
}

int write_figures(std::span<const Figure> figures, const Options& options) {
    const std::string id = options.figure.value_or("all");
    bool found = false;
    std::string known;
    for (const Figure& figure : figures) {
        known += fmt::format(" {}", figure.id);
        if (id != "all" && id != figure.id) continue;
        write_figure(figure, options);
        found = true;
    }
    if (!found)
        throw usage_error(fmt::format("--figure {}: no such figure; there are:{} all", id, known));
    return static_cast<int>(ExitCode::ok);
}

}  // namespace space
