#include "chapters/ch02_intersection_tests/measured/data.hpp"

#include <stdexcept>

namespace space::ch02 {

double ns_of(const std::vector<Timed>& times, std::string_view test) {
    for (const Timed& timed : times)
        if (timed.test == test) return timed.ns;
    throw std::out_of_range("no time of " + std::string(test));
}

std::string_view name(Pattern pattern) {
    switch (pattern) {
        case Pattern::all_hit:
            return "all hit";
        case Pattern::all_miss:
            return "all miss";
        case Pattern::unpredictable:
            return "unpredictable";
    }
    return "";
}

double relative_time(const SceneTimes& scene, std::string_view test) {
    return ns_of(scene.tests, test) / ns_of(scene.tests, "moller-trumbore-float");
}

}  // namespace space::ch02
