#include "common/program/error.hpp"
#include "common/scenes/makers.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace space {
namespace {

struct Maker {
    SceneRecipe recipe;
    void (*make)(Scene& scene, std::uint32_t size, std::uint64_t seed);
};

/// Where Debian's glmark2-data puts the Stanford bunny of 69,666 triangles.
constexpr const char* bunny_file = "/usr/share/glmark2/models/bunny.obj";

TriangleMesh load_bunny() {
    if (!std::filesystem::exists(bunny_file))
        throw input_error(
            fmt::format("{}: not there; it comes with Debian's package glmark2-data", bunny_file));
    return load_mesh(bunny_file);
}

/// What ./book scenes fetches; the environment may name another folder.
std::filesystem::path fetched_file(std::string_view name) {
    const char* const folder = std::getenv("BOOK_SCENES");
    return std::filesystem::path(folder ? folder : "build/scenes") / fmt::format("{}.ply", name);
}

TriangleMesh load_fetched(std::string_view name) {
    const std::filesystem::path file = fetched_file(name);
    if (!std::filesystem::exists(file))
        throw input_error(
            fmt::format("{}: not there; ./book scenes fetches it (BOOK_SCENES names its folder)",
                        file.string()));
    return load_mesh(file);
}

void make_bunny(Scene& scene, std::uint32_t, std::uint64_t) {
    scene.mesh = load_bunny();
    frame_mesh(scene);
}
void make_dragon_48k(Scene& scene, std::uint32_t, std::uint64_t) {
    scene.mesh = load_fetched("dragon_48k");
    frame_mesh(scene);
}
void make_dragon_871k(Scene& scene, std::uint32_t, std::uint64_t) {
    scene.mesh = load_fetched("dragon_871k");
    frame_mesh(scene);
}
void make_conference(Scene& scene, std::uint32_t, std::uint64_t) {
    scene.mesh = load_fetched("conference");
    scene.camera = {.eye = {7.0f, 2.4f, 4.2f}, .target = {-2.0f, 0.6f, -0.5f}, .field_of_view = 60};
    for (const double x : {-5.0, 0.0, 5.0})
        add_light(scene, {x, 2.3, 0.3}, {x, 0.7, 0.0}, Color{0.50f, 0.48f, 0.44f});
    add_light(scene, {7.0, 2.3, 4.2}, {3.0, 0.7, 0.5}, Color{0.30f, 0.30f, 0.33f});
}
void make_forest(Scene& scene, std::uint32_t, std::uint64_t) {
    scene.mesh = load_fetched("forest");
    scene.camera = {.eye = {11.0f, 3.5f, 11.0f}, .target = {0.0f, 2.0f, 0.0f}, .field_of_view = 45};
    scene.background = srgb(0xBFDCEC);
    add_light(scene, {300, 500, 250}, {0, 0, 0}, Color{0.95f, 0.88f, 0.75f});
    add_light(scene, {150, 100, 400}, {0, 0, 0}, Color{0.25f, 0.28f, 0.32f});
}

constexpr Maker makers[] = {
    {{"room",
      "a lit room with a teapot on a table; SIZE: the teapot's detail, or 'bunny' or a mesh file "
      "to put there",
      6, 2, 200},
     make_room},
    {{"sphereflake", "spheres on spheres; SIZE: levels, each with nine times as many", 2, 1, 6},
     make_sphereflake},
    {{"tetra", "Sierpinski's tetrahedron, most rays pass through; SIZE: levels, 4^SIZE triangles",
      6, 4, 11},
     make_tetra},
    {{"tree", "a forking tree on a huge field; SIZE: levels of branches", 7, 3, 14}, make_tree},
    {{"mount", "a fractal mountain; SIZE: levels, 2 * 4^SIZE triangles and four balls", 6, 3, 11},
     make_mount},
    {{"lattice", "balls joined by rods along the axes; SIZE: cells along an edge", 4, 1, 40},
     make_lattice},
    {{"shells", "a shell of overlapping balls of many sizes; SIZE: 180 * 2^SIZE + 1 balls", 2, 1,
      8},
     make_shells},
    {{"icosphere", "a geodesic sphere; SIZE: its frequency, 20 SIZE^2 triangles", 12, 4, 1000},
     make_icosphere},
    {{"soup", "SIZE random triangles of equal size in the unit cube", 2000, 200, 20'000'000},
     make_soup},
    {{"soup_uneven", "SIZE random triangles whose sizes differ by orders of magnitude", 2000, 200,
      20'000'000},
     make_soup_uneven},
    {{"slivers", "SIZE triangles, each as long as the scene and very thin", 1000, 200, 20'000'000},
     make_slivers},
    {{"dust", "SIZE specks, each far smaller than the gap to the next: nearly all rays miss",
      20'000, 200, 20'000'000},
     make_dust},
    {{"blanket", "SIZE small triangles over a huge slanted one, whose box holds them all", 2000,
      200, 20'000'000},
     make_blanket},
    {{"scan", "a stone head as a scanner gives it; SIZE: its frequency, 20 SIZE^2 triangles", 60, 4,
      1000},
     make_scan},
    {{"boxes", "a town of SIZE axis-aligned boxes", 400, 36, 1'000'000}, make_boxes},
    {{"stadium",
      "a teapot in a stadium: nearly everything in one small place; SIZE: the teapot's detail", 12,
      2, 300},
     make_stadium},
    {{"building", "a doll's house of SIZE storeys, each of eight furnished rooms", 3, 1, 200},
     make_building},
    {{"bunny", "Stanford's bunny, where Debian's package glmark2-data is installed", 0, 0, 0, true},
     make_bunny},
    {{"dragon_48k", "Stanford's dragon, coarse; ./book scenes fetches it", 0, 0, 0, true},
     make_dragon_48k},
    {{"dragon_871k", "Stanford's dragon; ./book scenes fetches it", 0, 0, 0, true},
     make_dragon_871k},
    {{"conference", "a conference room; ./book scenes puts it together", 0, 0, 0, true},
     make_conference},
    {{"forest", "plants on a wide ground; ./book scenes puts them together", 0, 0, 0, true},
     make_forest},
};

const Maker* find_maker(std::string_view name) {
    const auto found = std::find_if(std::begin(makers), std::end(makers),
                                    [&](const Maker& maker) { return maker.recipe.name == name; });
    return found == std::end(makers) ? nullptr : &*found;
}

/// "12", "bunny", "mesh.obj" in "room:mesh.obj": does it name a file?
bool is_path(std::string_view text) {
    return text.find_first_of("./") != std::string_view::npos;
}

std::string all_names() {
    std::string names;
    for (const Maker& maker : makers)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", maker.recipe.name);
    return names;
}

/// "12" -> 12, where the recipe allows it.
std::uint32_t parse_size(const SceneRecipe& recipe, std::string_view text) {
    std::uint32_t size = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (recipe.default_size == 0)
        throw usage_error(fmt::format("scene {}: it has no size, '{}'", recipe.name, text));
    if (error != std::errc{} || end != text.data() + text.size() || size < 1 ||
        size > recipe.max_size)
        throw usage_error(
            fmt::format("scene {}: the size must be a whole number from 1 to {}, not '{}'",
                        recipe.name, recipe.max_size, text));
    return size;
}

/// The distance nearest to the wanted one at which an eye can stand: floats end at 3.4e38, and far
/// from the origin they are so coarse that an eye beside a small mesh would be rounded into it.
double possible_distance(const Double3& target, const Double3& from, double wanted) {
    double nearest = 0.0, farthest = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        nearest = std::max(nearest, 16.0 * 0x1p-23 * std::abs(target[axis]));
        farthest = std::min(
            farthest, (double{std::numeric_limits<float>::max()} - target[axis]) / from[axis]);
    }
    return std::min(std::max(wanted, nearest), farthest);
}

Scene load_scene(const std::string& file) {
    Scene scene;
    scene.name = std::filesystem::path(file).stem().string();
    scene.mesh = load_mesh(file);
    frame_mesh(scene);
    return scene;
}

}  // namespace

std::span<const SceneRecipe> scene_recipes() {
    static const std::vector<SceneRecipe> recipes = [] {
        std::vector<SceneRecipe> list;
        for (const Maker& maker : makers) list.push_back(maker.recipe);
        return list;
    }();
    return recipes;
}

Scene make_scene(std::string_view spec, std::uint64_t seed, bool small) {
    const std::size_t colon = spec.find(':');
    const std::string_view name = spec.substr(0, colon);
    const Maker* const maker = find_maker(name);
    if (!maker) {
        if (is_path(spec)) return load_scene(std::string(spec));
        throw usage_error(fmt::format(
            "no scene is called '{}': give a mesh file (.obj, .off, .ply, .stl) or one of {}", name,
            all_names()));
    }
    Scene scene;
    scene.name = name;
    if (colon == std::string_view::npos) {
        maker->make(scene, small ? maker->recipe.small_size : maker->recipe.default_size, seed);
        return scene;
    }
    const std::string_view argument = spec.substr(colon + 1);
    if (name == "room" && argument == "bunny")
        make_room_with(scene, load_bunny());
    else if (name == "room" && is_path(argument))
        make_room_with(scene, load_mesh(std::string(argument)));
    else
        maker->make(scene, parse_size(maker->recipe, argument), seed);
    return scene;
}

std::filesystem::path scene_file(std::string_view spec) {
    const std::size_t colon = spec.find(':');
    const std::string_view name = spec.substr(0, colon);
    const Maker* const maker = find_maker(name);
    if (!maker) return is_path(spec) ? spec : "";
    const std::string_view argument = colon == std::string_view::npos ? "" : spec.substr(colon + 1);
    if (name == "bunny" || argument == "bunny") return bunny_file;
    if (maker->recipe.from_file) return fetched_file(name);
    return is_path(argument) ? argument : "";
}

void frame_mesh(Scene& scene) {
    const Aabb box = bounds(scene.mesh);
    const Double3 target = 0.5 * (Double3(box.min) + Double3(box.max));
    const Double3 from = glm::normalize(Double3{0.35, 0.3, 1.0});
    scene.camera = {.target = Point3(target), .field_of_view = 32.0f};
    const CameraFrame frame(
        {.eye = Point3(from), .target = Point3(0.0f), .field_of_view = scene.camera.field_of_view});
    constexpr double filled = 0.9;  // of the picture's height or width
    const auto off_axis = [&](const Double3& p) {
        return std::max(std::abs(glm::dot(p, frame.up)), std::abs(glm::dot(p, frame.right)));
    };
    // As near as the picture's frame allows, with a margin, if the picture is at least as wide as
    // high.
    double wanted = 0.0;
    for (const Point3& vertex : scene.mesh.vertices) {
        const Double3 p = Double3(vertex) - target;
        wanted =
            std::max(wanted, glm::dot(p, frame.back) + off_axis(p) / (filled * frame.tan_half_fov));
    }
    if (wanted == 0.0) wanted = 1.0;  // a single point
    const double distance = possible_distance(target, from, wanted);
    if (distance != wanted) {  // then another field of view shows the mesh
        double tan_half_fov = 0.0;
        for (const Point3& vertex : scene.mesh.vertices) {
            const Double3 p = Double3(vertex) - target;
            const double depth = distance - glm::dot(p, frame.back);
            tan_half_fov =
                std::max(tan_half_fov, depth > 0.0 ? off_axis(p) / (filled * depth) : infinity);
        }
        const double degrees = 2.0 * std::atan(tan_half_fov) * 180.0 / 3.14159265358979323846;
        scene.camera.field_of_view = static_cast<float>(std::clamp(degrees, 1e-4, 120.0));
    }
    scene.camera.eye = Point3(target + distance * from);
    scene.background = srgb(0xDCE6EE);
    add_light(scene, target + distance * Double3{-0.8, 1.1, 1.0}, target,
              Color{0.95f, 0.88f, 0.78f});
    add_light(scene, target + distance * Double3{1.2, 0.3, 0.9}, target,
              Color{0.16f, 0.20f, 0.26f});
    add_light(scene, target + distance * Double3{0.3, 0.2, 1.5}, target,
              Color{0.12f, 0.12f, 0.12f});
}

}  // namespace space
