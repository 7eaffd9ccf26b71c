#include "chapters/ch12_comparison/lab_options.hpp"

#include "common/program/error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <thread>

namespace space {
namespace {

constexpr int max_repeat = 10'000;

constexpr const char* formats = R"(
Files
  --rays   records of eight little-endian float32: ox oy oz tmin dx dy dz tmax. A ray is origin +
           t direction with t in [tmin, tmax]; the direction need not have length 1. A ray with a
           NaN, an infinite origin or direction, a direction of zero or tmin > tmax is a miss, and
           the number of such rays is printed. A file that does not hold whole records, or none, is
           an error.
  --hits   one record a ray, little-endian: float32 t u v, uint32 triangle (from 0, in the order of
           the mesh file). t is in units of the direction; the point is (1 - u - v) a + u b + v c.
           A miss is t = infinity, u = v = 0, triangle 0xFFFFFFFF. With --query any a hit has no
           triangle and no place: t = u = v = 0, triangle 0xFFFFFFFE. Needs exactly one structure.
  --json   the table as JSON: version, machine, mesh, query, structures; null where a figure has no
           meaning.
Exit codes: 0, 1 where --check found a disagreement, 2 usage, 3 bad input, 4 cannot write.
Nothing is written before all is measured, and a file that cannot be written whole is not there.)";

/// "a,b,c" -> "a", "b", "c"; empty entries stay.
std::vector<std::string> split(std::string_view text) {
    std::vector<std::string> parts;
    for (std::size_t comma; (comma = text.find(',')) != text.npos; text.remove_prefix(comma + 1))
        parts.emplace_back(text.substr(0, comma));
    parts.emplace_back(text);
    return parts;
}

Camera parse_camera(const std::string& text) {
    const auto fault = [&](std::string_view what) {
        return usage_error(fmt::format("--camera {}: {}", text, what));
    };
    std::vector<float> numbers;
    for (const std::string& part : split(text)) {
        float number = 0.0f;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
        if (error != std::errc{} || end != part.data() + part.size() || !std::isfinite(number))
            throw fault(fmt::format("'{}' is not a finite number", part));
        numbers.push_back(number);
    }
    if (numbers.size() != 7) throw fault("give seven numbers ex,ey,ez,tx,ty,tz,fov");
    Camera camera{.eye = {numbers[0], numbers[1], numbers[2]},
                  .target = {numbers[3], numbers[4], numbers[5]},
                  .field_of_view = numbers[6]};
    if (camera.eye == camera.target) throw fault("eye and target are the same point");
    if (!(camera.field_of_view > 0.0f && camera.field_of_view < 180.0f))
        throw fault("the field of view must lie between 0 and 180 degrees");
    if (camera.eye.x == camera.target.x && camera.eye.z == camera.target.z)
        camera.up = {0.0f, 0.0f, -1.0f};  // looking straight up or down
    return camera;
}

}  // namespace

LabOptions parse_lab_options(int argc, char** argv) {
    LabOptions options;
    std::string structures = "all", query = "closest";
    std::optional<std::string> camera_numbers;
    CLI::App app("Any structure of the book on your own mesh and rays.", "lab");
    app.footer(formats);
    auto* mesh = app.add_option("--mesh", options.mesh, "a mesh file: OBJ, PLY, STL or OFF")
                     ->type_name("FILE");
    app.add_option("--scene", options.common.scene, "a scene by name")
        ->type_name("NAME[:SIZE]")
        ->excludes(mesh);
    auto* rays = app.add_option("--rays", options.rays,
                                "trace these rays; default: through the camera's pixels");
    auto* camera =
        app.add_option("--camera", camera_numbers,
                       "eye, target, vertical field of view in degrees; default: the scene's own");
    auto* diffuse = add_whole_number(
        app, "--diffuse", 1, max_rays, [&](std::uint64_t n) { options.diffuse = n; },
        "trace N rays that leave the camera rays' hits, cosine-distributed (by --seed)");
    add_common_options(app, options.common);
    app.add_option("--structure", structures, "NAME[,NAME...], 'all' or 'list'")
        ->capture_default_str();
    app.add_option("--triangle-test", options.triangle_test,
                   "NAME or 'list'; default: each structure's first");
    app.add_option("--query", query, "the nearest hit, or whether there is any")
        ->check(CLI::IsMember({"closest", "any"}))
        ->capture_default_str();
    add_whole_number(
        app, "--build-threads", 1, max_threads,
        [&](std::uint64_t n) { options.build_threads = static_cast<unsigned>(n); },
        "for builders that use several; default: as --threads");
    add_whole_number(
        app, "--repeat", 1, max_repeat,
        [&](std::uint64_t n) { options.repeat = static_cast<int>(n); },
        "timed runs of each build and trace, in turn; their medians count")
        ->default_str(fmt::format("{}", options.repeat));
    app.add_option("--hits", options.hits, "write the answers to this file")->type_name("FILE");
    app.add_option("--json", options.json, "write the measurements to this file")
        ->type_name("FILE");
    app.add_flag("--check", options.check, "compare the answers with naive tracing");
    rays->type_name("FILE")->excludes(camera)->excludes(diffuse)->excludes(
        app.get_option("--size"));
    camera->type_name("ex,ey,ez,tx,ty,tz,fov");
    parse_command_line(app, argc, argv);

    options.structures = split(structures);
    options.query = query == "any" ? Query::any : Query::closest;
    if (camera_numbers) options.camera = parse_camera(*camera_numbers);
    if (options.common.threads == 0)
        options.common.threads = std::max(1u, std::thread::hardware_concurrency());
    if (options.build_threads == 0) options.build_threads = options.common.threads;
    return options;
}

}  // namespace space
