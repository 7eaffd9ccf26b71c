#include "chapters/ch12_comparison/camera_option.hpp"

#include "common/geometry.hpp"
#include "common/program/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace space {
namespace {

/// As people write it: "10", "+10", " 0". @return nothing for what is no number; it may be infinite
std::optional<float> number_in(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    float number = 0.0f;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc::result_out_of_range) return infinity;
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

Camera parse_camera(const std::string& text) {
    const auto fault = [&](std::string_view what) {
        return usage_error(fmt::format("--camera {}: {}", text, what));
    };
    std::vector<float> numbers;
    for (std::size_t begin = 0, end; begin <= text.size(); begin = end + 1) {
        end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        const std::optional<float> number = number_in(part);
        if (!number) throw fault(fmt::format("'{}' is not a number", part));
        if (!std::isfinite(*number)) throw fault(fmt::format("'{}' is not finite", part));
        numbers.push_back(*number);
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

CLI::Option* add_camera_option(CLI::App& app, std::optional<Camera>& camera) {
    return app
        .add_option_function<std::string>(
            "--camera", [&](const std::string& text) { camera = parse_camera(text); },
            "eye, target, vertical field of view in degrees; default: the scene's own")
        ->type_name("ex,ey,ez,tx,ty,tz,fov");
}

}  // namespace space
