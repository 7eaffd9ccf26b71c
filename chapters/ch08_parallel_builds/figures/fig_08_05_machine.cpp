// Two packages of a recorded machine.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/topology_drawing.hpp"
#include "chapters/ch08_parallel_builds/recorded_machines.hpp"

#include <stdexcept>

namespace space::ch08 {

Svg fig_08_05(const Options&) {
    for (const RecordedMachine& machine : recorded_machines())
        if (machine.name == "two-xeons") return topology_drawing(view_by_cpuid(machine.processors));
    throw std::logic_error("no such machine is recorded");
}

}  // namespace space::ch08
