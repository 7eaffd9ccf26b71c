#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"

#include "common/limit_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace space {
namespace {

/// No entry of a matrix or of its inverse is larger: sums of their products with floats then stay
/// far from the ends of what doubles hold.
constexpr double largest_entry = 0x1p200;

bool is_moderate(const Affine& map) {
    for (const auto& row : map.rows)
        for (const double entry : row)
            if (!(std::abs(entry) <= largest_entry)) return false;
    return true;
}

std::string quoted(const GraphObject& object) {
    return "\"" + object.name + "\"";
}

void check_instance(const GraphObject& group, std::size_t number, std::size_t objects) {
    const auto& [map, object] = group.instances[number];
    const auto refuse = [&](const std::string& why) {
        throw GraphError("group " + quoted(group) + ", instance " + std::to_string(number + 1) +
                         ": " + why);
    };
    if (object >= objects) refuse("there is no object " + std::to_string(object));
    if (!is_finite(map)) refuse("its matrix has an entry that is not finite");
    const auto back = inverse(map);
    if (!back) refuse("its matrix is singular, or too near to it");
    if (!is_moderate(map) || !is_moderate(*back))
        refuse("its matrix or the inverse has an entry larger than 2^200");
}

}  // namespace

SceneGraph::SceneGraph(std::vector<GraphObject> objects, std::uint32_t root)
    : objects_(std::move(objects)), root_(root) {
    if (root >= objects_.size())
        throw GraphError("the root is object " + std::to_string(root) + ", and there are " +
                         std::to_string(objects_.size()));
    for (const GraphObject& object : objects_) check(object);
    order_from_below();
    count();
}

void SceneGraph::check(const GraphObject& object) const {
    if (!object.triangles.empty() && !object.instances.empty())
        throw GraphError("object " + quoted(object) + " has triangles and instances");
    if (object.triangles.size() > std::size_t{1} << 31)
        throw GraphError("mesh " + quoted(object) + " has more than 2147483648 triangles");
    for (std::size_t i = 0; i < object.instances.size(); ++i)
        check_instance(object, i, objects_.size());
}

// [order_from_below]
/// Depth first; an object is in the order when all that it holds is. Whoever comes to an object
/// that is still open has come in a circle.
void SceneGraph::order_from_below() {
    enum class State { unseen, open, done };
    struct Open {
        std::uint32_t object;
        std::size_t next = 0;  ///< of its instances
    };
    std::vector<State> states(objects_.size(), State::unseen);
    std::vector<Open> path{{root_}};
    states[root_] = State::open;
    from_below_.clear();
    while (!path.empty()) {
        auto& [object, next] = path.back();
        if (next == objects_[object].instances.size()) {
            states[object] = State::done;
            from_below_.push_back(object);
            path.pop_back();
            continue;
        }
        const std::uint32_t held = objects_[object].instances[next++].object;
        if (states[held] == State::open) {
            std::string names;
            for (auto at = std::ranges::find(path, held, &Open::object); at != path.end(); ++at)
                names += quoted(objects_[at->object]) + " holds ";
            throw GraphError("a group holds itself: " + names + quoted(objects_[held]));
        }
        if (states[held] == State::unseen) {
            states[held] = State::open;
            path.push_back({held});
        }
    }
}
// [order_from_below]

void SceneGraph::count() {
    counts_.assign(objects_.size(), {});
    for (const std::uint32_t index : from_below_) {
        const GraphObject& object = objects_[index];
        Counts& counts = counts_[index];
        counts.triangles = object.triangles.size();
        counts.first.reserve(object.instances.size());
        for (const Instance& instance : object.instances) {
            const Counts& held = counts_[instance.object];
            if (held.triangles > (std::uint64_t{1} << 63) - counts.triangles)
                throw GraphError("group " + quoted(object) + " has more than 2^63 triangles");
            counts.first.push_back(counts.triangles);
            counts.triangles += held.triangles;
            counts.height = std::max(counts.height, held.height + 1);
        }
        if (counts.height > max_graph_height)
            throw GraphError("group " + quoted(object) + " is nested deeper than " +
                             std::to_string(max_graph_height));
    }
}

std::size_t SceneGraph::bytes() const {
    std::size_t bytes = sizeof *this + from_below_.size() * sizeof(std::uint32_t) +
                        objects_.size() * (sizeof(GraphObject) + sizeof(Counts));
    for (const GraphObject& object : objects_)
        bytes += object.triangles.size() * sizeof(Triangle) +
                 object.instances.size() * (sizeof(Instance) + sizeof(std::uint64_t));
    return bytes;
}

// [locate]
Located SceneGraph::locate(std::uint64_t triangle) const {
    Located at{root_, 0, {}};
    while (!objects_[at.mesh].instances.empty()) {
        const std::vector<std::uint64_t>& first = counts_[at.mesh].first;
        // The last that begins no later: those before it that begin there, too, are empty.
        const auto instance =
            static_cast<std::size_t>(std::ranges::upper_bound(first, triangle) - first.begin()) - 1;
        triangle -= first[instance];
        const Instance& down = objects_[at.mesh].instances[instance];
        at.to_world = composed(at.to_world, down.to_parent);
        at.mesh = down.object;
    }
    at.triangle = static_cast<std::uint32_t>(triangle);
    return at;
}
// [locate]

void SceneGraph::move(std::uint32_t group, std::vector<Instance> instances) {
    std::swap(objects_[group].instances, instances);
    try {
        check(objects_[group]);
        order_from_below();
        count();
    } catch (...) {
        std::swap(objects_[group].instances, instances);
        order_from_below();
        count();
        throw;
    }
}

namespace {

// [flatten]
void flatten_below(const SceneGraph& graph, std::uint32_t object, const Affine& to_world,
                   std::vector<Triangle>& all) {
    if (graph.triangle_count(object) == 0) return;  // or groups of groups of nothing take for ever
    for (const Triangle& triangle : graph.object(object).triangles)
        all.push_back(flattened(to_world, triangle));
    for (const Instance& instance : graph.object(object).instances)
        flatten_below(graph, instance.object, composed(to_world, instance.to_parent), all);
}
// [flatten]

}  // namespace

std::vector<Triangle> flatten(const SceneGraph& graph, std::uint64_t most) {
    if (graph.triangle_count() > most)
        throw LimitError("scene graph: " + std::to_string(graph.triangle_count()) +
                         " triangles, more than " + std::to_string(most));
    std::vector<Triangle> all;
    all.reserve(graph.triangle_count());
    flatten_below(graph, graph.root(), Affine{}, all);
    return all;
}

}  // namespace space
