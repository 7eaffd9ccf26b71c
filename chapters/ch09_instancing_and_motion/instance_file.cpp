#include "chapters/ch09_instancing_and_motion/instance_file.hpp"

#include "common/mesh.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace space {
namespace {

using Json = nlohmann::json;
using Place = Json::json_pointer;

/// Text on its way to the parser, which tells how far it has come.
struct Tape {
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = char;

    const char* at;
    const char** farthest;

    char operator*() const { return *at; }
    Tape& operator++() {
        *farthest = ++at;
        return *this;
    }
    bool operator==(const Tape& other) const { return at == other.at; }
};

/// A number in a row of a matrix of an instance in the list that is a group, one of the groups, in
/// the file: nothing is nested deeper.
constexpr std::size_t deepest = 7;

/// A name in a file may hold any character, a line's end among them: '?' for what is none to be
/// seen.
std::string printable(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    return text;
}

/// Parses, and calls value(place, end) where a value begins or, if it is a number or a text, has
/// been read, named(place, depth, again, end) for each name, which its object may have had before,
/// and too_deep(end) where a list or an object is nested so deep that nothing in it has a meaning.
/// `end` is behind what has been read.
template <class Value, class Named, class TooDeep>
Json parse(const std::string& text, const char*& end, const Value& value, const Named& named,
           const TooDeep& too_deep) {
    struct Open {
        bool is_list;
        std::string member = {};  ///< the name or number of the one in hand
        std::size_t members = 0;
        std::set<std::string> names = {};
    };
    std::vector<Open> path;
    const auto place = [&] {
        Place here;
        for (const Open& open : path) here /= open.member;
        return here;
    };
    const auto begin_value = [&] {
        if (!path.empty() && path.back().is_list)
            path.back().member = std::to_string(path.back().members++);
        value(place, end);
    };
    using Event = Json::parse_event_t;
    const auto told = [&](int, Event event, const Json& parsed) {
        if (event == Event::key) {
            path.back().member = parsed.get<std::string>();
            named(place, path.size(), !path.back().names.insert(path.back().member).second, end);
        } else if (event == Event::object_end || event == Event::array_end) {
            path.pop_back();
        } else {
            begin_value();
            if (event == Event::value) return true;
            path.push_back({event == Event::array_start});
            if (path.size() > deepest) too_deep(end);
        }
        return true;
    };
    end = text.data();
    return Json::parse(Tape{text.data(), &end}, Tape{text.data() + text.size(), &end}, told);
}

/// Reads one file.
class Reader {
  public:
    explicit Reader(const std::filesystem::path& file) : file_(file), text_(read_file(file)) {
        const char* end = nullptr;
        try {
            json_ = parse(
                text_, end, [](const auto&, const char*) {},
                [&](const auto& place, std::size_t depth, bool again, const char* at) {
                    if (again) fail_at(at, fmt::format("\"{}\" is there twice", place().back()));
                    if (depth == 2) named_.push_back(place());
                },
                [&](const char* at) {
                    fail_at(at, "nested deeper than a number in a matrix of an instance");
                });
        } catch (const Json::exception& error) {
            const std::string_view told = error.what();
            const std::size_t column = told.find("column ");
            fail_at(end, std::string(told.substr(told.find(column == told.npos ? "] " : ": ",
                                                           column == told.npos ? 0 : column) +
                                                 2)));
        }
    }

    InstanceFile graph() {
        check_members(json_, Place(), {"meshes", "groups", "scene"}, "the file");
        const Json& meshes = member(json_, "meshes");
        const Json& groups = member(json_, "groups");
        for (const char* kind : {"meshes", "groups"})
            for (const std::string& name : names(kind)) {
                if (!index_.try_emplace(name, objects_.size()).second)
                    fail(Place() / kind / name, fmt::format("\"{}\" is a mesh, too", name));
                objects_.push_back({name});
            }
        for (const std::string& name : names("meshes")) read_mesh(name, meshes[name]);
        for (const std::string& name : names("groups")) read_group(name, groups[name]);
        if (!json_.contains("scene"))
            fail(Place(), "there is no \"scene\": the object that is traced");
        const std::uint32_t root = object(json_["scene"], Place() / "scene");
        try {
            return {SceneGraph(std::move(objects_), root), std::move(remarks_)};
        } catch (const GraphError& error) {
            throw input_error(fmt::format("{}: {}", file_.string(), printable(error.what())));
        }
    }

    std::vector<std::filesystem::path> mesh_files() const {
        std::vector<std::filesystem::path> files;
        if (!json_.is_object() || !json_.contains("meshes")) return {};
        for (const auto& [name, mesh] : json_["meshes"].items())
            if (mesh.is_string()) files.push_back(scene_file(mesh_name(mesh)));
        return files;
    }

  private:
    [[noreturn]] void fail_at(const char* where, const std::string& fault) const {
        throw input_error(fmt::format("{}:{}: {}", file_.string(),
                                      1 + std::count(text_.data(), where, '\n'), printable(fault)));
    }
    /// Finds the line by parsing once more. The parser reads one letter beyond a number.
    [[noreturn]] void fail(const Place& place, const std::string& fault) const {
        const char *end = nullptr, *found = text_.data();
        parse(
            text_, end,
            [&](const auto& here, const char* at) {
                if (here() == place) found = at - (json_.at(place).is_number() ? 1 : 0);
            },
            [](const auto&, std::size_t, bool, const char*) {}, [](const char*) {});
        fail_at(found, fault);
    }
    void check_members(const Json& json, const Place& place,
                       std::initializer_list<std::string_view> known, const std::string& of) const {
        if (!json.is_object()) fail(place, of + " must be an object, in { }");
        for (const auto& [name, value] : json.items())
            if (std::ranges::count(known, name) == 0)
                fail(place / name, fmt::format("{}: \"{}\" is not known here", of, name));
    }
    /// An object in the file's own; an empty one where it is not there.
    const Json& member(const Json& json, const char* name) const {
        static const Json none = Json::object();
        if (!json.contains(name)) return none;
        if (!json[name].is_object())
            fail(Place() / name, fmt::format("\"{}\" must be an object, in {{ }}", name));
        return json[name];
    }
    /// Of the meshes or of the groups, in their order, which numbers the triangles.
    std::vector<std::string> names(const std::string& kind) const {
        std::vector<std::string> names;
        for (const Place& place : named_)
            if (place.parent_pointer() == Place() / kind) names.push_back(place.back());
        return names;
    }
    std::uint32_t object(const Json& json, const Place& place) const {
        if (!json.is_string()) fail(place, "the name of a mesh or a group is needed, in quotes");
        const auto found = index_.find(json.get<std::string>());
        if (found == index_.end())
            fail(place, fmt::format("there is no mesh or group \"{}\"", json.get<std::string>()));
        return static_cast<std::uint32_t>(found->second);
    }
    /// A file stands beside this one, if not somewhere else.
    std::string mesh_name(const Json& json) const {
        const auto name = json.get<std::string>();
        const bool is_path = name.find_first_of("./") != name.npos && name.find(':') == name.npos;
        return is_path ? (file_.parent_path() / name).string() : name;
    }
    void read_mesh(const std::string& name, const Json& json) {
        const Place place = Place() / "meshes" / name;
        if (!json.is_string())
            fail(place, fmt::format("mesh \"{}\": a file or a scene is needed, in quotes", name));
        try {
            const TriangleMesh mesh = make_scene(mesh_name(json)).mesh;
            remarks_.insert(remarks_.end(), mesh.remarks.begin(), mesh.remarks.end());
            objects_[index_[name]].triangles = mesh.triangles();
        } catch (const Error& error) {
            fail(place, fmt::format("mesh \"{}\": {}", name, error.what()));
        }
    }
    void read_group(const std::string& name, const Json& json) {
        const Place place = Place() / "groups" / name;
        if (!json.is_array())
            fail(place, fmt::format("group \"{}\" must be a list of instances, in [ ]", name));
        std::vector<Instance>& instances = objects_[index_[name]].instances;
        for (const Json& entry : json)
            instances.push_back(
                instance(entry, place / instances.size(),
                         fmt::format("group \"{}\", instance {}", name, instances.size() + 1)));
    }
    Instance instance(const Json& json, const Place& place, const std::string& of) const {
        check_members(json, place, {"object", "matrix"}, of);
        if (!json.contains("object")) fail(place, of + ": there is no \"object\"");
        Instance instance{.to_parent = {}, .object = object(json["object"], place / "object")};
        if (!json.contains("matrix")) return instance;
        const Json& matrix = json["matrix"];
        const auto is_list = [](const Json& list, std::size_t size) {
            return list.is_array() && list.size() == size;
        };
        if (!is_list(matrix, 3)) fail(place / "matrix", of + ": the matrix must have three rows");
        for (std::size_t i = 0; i < 3; ++i) {
            const Place row = place / "matrix" / i;
            if (!is_list(matrix[i], 4)) fail(row, of + ": each row of the matrix has four numbers");
            for (std::size_t j = 0; j < 4; ++j) {
                if (!matrix[i][j].is_number()) fail(row / j, of + ": this is not a number");
                instance.to_parent.rows[i][j] = matrix[i][j].get<double>();
            }
        }
        if (!inverse(instance.to_parent))
            fail(place / "matrix", of + ": the matrix is singular, or too near to it");
        return instance;
    }

    std::filesystem::path file_;
    std::string text_;
    Json json_;
    std::vector<Place> named_;  ///< what has a name in an object of the file, as they come
    std::vector<GraphObject> objects_;
    std::map<std::string, std::size_t> index_;  ///< of objects by name
    std::vector<std::string> remarks_;
};

}  // namespace

InstanceFile load_instances(const std::filesystem::path& file) {
    return Reader(file).graph();
}

std::vector<std::filesystem::path> meshes_of_instances(const std::filesystem::path& file) {
    try {
        return Reader(file).mesh_files();
    } catch (const Error&) {
        return {};
    }
}

}  // namespace space
