// Files of instances: what they say, and what is wrong with them, by line.
#include "chapters/ch09_instancing_and_motion/instance_file.hpp"

#include "common/mesh.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/temporary.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <string>

using namespace space;

namespace {

/// What is replaced in it makes each of the wrong ones.
constexpr const char* garden = R"({
 "meshes": {"flag": "flag.ply", "tree": "tree:3"},
 "groups": {
  "pair": [
   {"object": "flag"},
   {"object": "flag",
    "matrix": [[-2, 0, 0, 5],
               [0, 0.5, 0, 0],
               [0, 0, 1e3, 0.25]]}],
  "garden": [
   {"object": "pair"},
   {"object": "tree"},
   {"object": "nothing"}],
  "nothing": []},
 "scene": "garden"
})";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != text.npos);
    return text.replace(at, from.size(), to);
}

/// A folder with the mesh that the files name.
struct Folder {
    TemporaryDirectory directory;
    std::filesystem::path file = directory / "garden.json";

    Folder() {
        write_ply(directory / "flag.ply",
                  {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}});
    }
    InstanceFile load(const std::string& text) const {
        write_file(file, text);
        return load_instances(file);
    }
    /// What is told, without the file's name at the beginning.
    std::string refusal(const std::string& text) const {
        try {
            load(text);
        } catch (const Error& error) {
            CHECK(error.code() == ExitCode::bad_input);
            const std::string told = error.what(), name = file.string();
            CHECK(told.starts_with(name + ":"));
            CHECK(told.find('\n') == told.npos);
            return told.substr(name.size() + 1);
        }
        return "it was read";
    }
};

}  // namespace

TEST_CASE("a file's meshes, groups and matrices become the graph") {
    const Folder folder;
    const auto [graph, remarks] = folder.load(garden);
    CHECK(remarks.empty());
    const std::vector<Triangle> tree = make_scene("tree:3").mesh.triangles();
    REQUIRE(graph.triangle_count() == 2 + tree.size());
    const std::vector<Triangle> flat = flatten(graph);
    CHECK(flat[0] == Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(flat[1] == Triangle{{5, 0, 0.25f}, {3, 0, 0.25f}, {5, 0.5f, 0.25f}});
    CHECK(std::equal(tree.begin(), tree.end(), flat.begin() + 2));
    CHECK(graph.object(graph.root()).name == "garden");
}

TEST_CASE("triangles are counted in the order of the file, whatever the names") {
    const Folder folder;
    const std::string text = R"({"meshes": {"z": "flag.ply", "a": "flag.ply"},
        "groups": {"g": [{"object": "z", "matrix": [[1,0,0,7],[0,1,0,0],[0,0,1,0]]},
                         {"object": "a"}]}, "scene": "g"})";
    const SceneGraph graph = folder.load(text).graph;
    CHECK(graph.triangle(0).a.x == 7.0f);
    CHECK(graph.triangle(1).a.x == 0.0f);
}

TEST_CASE("a mesh alone is a scene, and so is nothing at all") {
    const Folder folder;
    CHECK(folder.load(R"({"meshes": {"m": "flag.ply"}, "scene": "m"})").graph.triangle_count() ==
          1);
    CHECK(folder.load(R"({"groups": {"g": []}, "scene": "g"})").graph.triangle_count() == 0);
}

TEST_CASE("what the readers of meshes passed over is handed on") {
    const Folder folder;
    write_file(folder.directory / "flag.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n");
    const auto file = folder.load(R"({"meshes": {"m": "flag.obj"}, "scene": "m"})");
    REQUIRE(file.remarks.size() == 1);
    CHECK(file.remarks.front().find("flag.obj: 1 statement skipped") != std::string::npos);
}

TEST_CASE("each fault of a file is told in one line that names the file, the line and the fault") {
    const Folder folder;
    struct Wrong {
        const char *from, *to, *told;
    };
    const Wrong wrongs[] = {
        {R"([0, 0.5, 0, 0])", R"([0, 0.5, 0])",
         R"(8: group "pair", instance 2: each row of the matrix has four numbers)"},
        {R"([0, 0.5, 0, 0])", R"(0.5)",
         R"(8: group "pair", instance 2: each row of the matrix has four numbers)"},
        {"[0, 0.5, 0, 0],", "", R"(7: group "pair", instance 2: the matrix must have three rows)"},
        {"[[-2, 0, 0, 5],", "[[-2, 0, 0, 5], [1, 0, 0, 0],",
         R"(7: group "pair", instance 2: the matrix must have three rows)"},
        {"1e3", R"("1e3")", R"(9: group "pair", instance 2: this is not a number)"},
        {"1e3", "null", R"(9: group "pair", instance 2: this is not a number)"},
        {"1e3", "1e999", "9: number overflow parsing '1e999'"},
        {"1e3", "NaN", "9: syntax error while parsing"},
        {"1e3", "Infinity", "9: syntax error while parsing"},
        {"1e3", "0", R"(7: group "pair", instance 2: the matrix is singular, or too near to it)"},
        {R"({"object": "tree"})", R"({"object": "tre"})", R"(12: there is no mesh or group "tre")"},
        {R"({"object": "tree"})", R"({"object": "tr\n\u001bee"})",
         R"(12: there is no mesh or group "tr??ee")"},
        {R"({"object": "tree"})", R"({"object": 7})",
         "12: the name of a mesh or a group is needed, in quotes"},
        {R"({"object": "tree"})", R"({"matrix": []})",
         R"(12: group "garden", instance 2: there is no "object")"},
        {R"({"object": "tree"})", R"({"object": "tree", "matrx": []})",
         R"(12: group "garden", instance 2: "matrx" is not known here)"},
        {R"({"object": "tree"})", R"({"object": "tree", "object": "flag"})",
         R"(12: "object" is there twice)"},
        {R"({"object": "tree"})", R"("tree")",
         R"(12: group "garden", instance 2 must be an object, in { })"},
        {R"({"object": "tree"})", R"({"object": "garden"})",
         R"( a group holds itself: "garden" holds "garden")"},
        {R"("nothing": [])", R"("nothing": {})",
         R"(14: group "nothing" must be a list of instances, in [ ])"},
        {R"("nothing": [])", R"("garden": [])", R"(14: "garden" is there twice)"},
        {R"("nothing": [])", R"("tree": [])", R"(14: "tree" is a mesh, too)"},
        {R"("tree:3")", R"("tree:99")",
         R"(2: mesh "tree": scene tree: the size must be a whole number from 1 to 14, not '99')"},
        {R"("tree:3")", "3", R"(2: mesh "tree": a file or a scene is needed, in quotes)"},
        {R"("tree:3")", R"("no_such_scene")", R"(2: mesh "tree": no scene is called)"},
        {R"("flag.ply")", R"("flaw.ply")", R"(2: mesh "flag": )"},
        {R"("scene": "garden")", R"("scene": "lawn")", R"(15: there is no mesh or group "lawn")"},
        {R"("scene": "garden")", R"("scen": "garden")",
         R"(15: the file: "scen" is not known here)"},
        {",\n \"scene\": \"garden\"", "", R"(1: there is no "scene": the object that is traced)"},
        {R"("meshes": {)", R"("meshes": [], "x": {)", R"(2: the file: "x" is not known here)"},
        {R"([0, 0, 1e3, 0.25]]})", R"([0, 0, 1e3, 0.25]})", "9: syntax error while parsing array"},
    };
    for (const auto& [from, to, told] : wrongs) {
        INFO(from << " -> " << to);
        const std::string refusal = folder.refusal(replaced(garden, from, to));
        INFO(refusal);
        CHECK(refusal.starts_with(told));
    }
    for (const char* text : {"", "[", "[]", "1", "{", "\"", "{\"scene\": \"\xff\"}", "null"}) {
        INFO(text);
        CHECK(folder.refusal(text).starts_with("1: "));
    }
}

TEST_CASE(
    "a file that is not there is refused, and deep lists and long files are read or refused") {
    const Folder folder;
    CHECK_THROWS_AS(load_instances(folder.directory / "none.json"), Error);
    CHECK_THROWS_AS(load_instances(folder.directory / ""), Error);
    CHECK(folder.refusal(std::string(100'000, '[')).starts_with("1: nested deeper"));
    std::string deep = "{\n\"x\": " + std::string(100'000, '[') + std::string(100'000, ']') + "}";
    CHECK(folder.refusal(deep).starts_with("2: nested deeper"));
    CHECK(folder.refusal("{\"scene\": [[[[[[7]]]]]]}").starts_with("1: the name of a mesh"));
    std::string many = R"({"meshes": {"m": "flag.ply"}, "scene": "g", "groups": {"g": [)";
    const int count = sized(20'000, 500);
    for (int i = 0; i < count; ++i)
        many += R"({"object": "m", "matrix": [[1,0,0,1],[0,1,0,2],[0,0,1,3]]},)"
                "\n";
    many += R"({"object": "m"}]}})";
    CHECK(folder.load(many).graph.triangle_count() == std::uint64_t(count) + 1);
    many.replace(many.rfind("\"m\"}"), 3, "\"n\"");
    CHECK(folder.refusal(many).starts_with(std::to_string(count + 1) + ": there is no mesh"));
    std::string groups = "{\"groups\": {\"g\": []";
    for (int i = 0; i < 5 * count; ++i) groups += ",\n\"" + std::to_string(i) + "\": []";
    CHECK(folder.load(groups + "}, \"scene\": \"g\"}").graph.objects().size() ==
          std::size_t(5 * count) + 1);
}

TEST_CASE("the meshes that a file names are known before it is read") {
    const Folder folder;
    write_file(folder.file, garden);
    const auto files = meshes_of_instances(folder.file);
    REQUIRE(files.size() == 2);
    CHECK(files[0] == folder.directory / "flag.ply");
    CHECK(files[1].empty());  // a scene is made
    write_file(folder.file, "{");
    CHECK(meshes_of_instances(folder.file).empty());
}
