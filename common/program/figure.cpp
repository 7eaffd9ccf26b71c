#include "common/program/figure.hpp"

#include "common/program/error.hpp"

#include <fmt/format.h>

namespace space {

int make_figures(std::span<const Figure> figures, const Options& options) {
    const std::string id = options.figure.value_or("all");
    bool found = false;
    std::string known;
    for (const Figure& figure : figures) {
        known += fmt::format(" {}", figure.id);
        if (id != "all" && id != figure.id) continue;
        figure.make(options);
        found = true;
    }
    if (!found)
        throw usage_error(fmt::format("--figure {}: no such figure; there are:{} all", id, known));
    return static_cast<int>(ExitCode::ok);
}

}  // namespace space
