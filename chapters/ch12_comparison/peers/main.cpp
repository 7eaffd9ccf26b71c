/// The lab beside other people's structures. Run   lab_with_peers --scene sphereflake --check
/// --against embree,   or the chapter's comparison with them   lab_with_peers compare --out DIR
#include "chapters/ch12_comparison/lab.hpp"
#include "chapters/ch12_comparison/measured/comparison.hpp"
#include "chapters/ch12_comparison/peers/peers.hpp"
#include "common/program/error.hpp"

#include <string_view>
#include <utility>
#include <vector>

namespace {

std::vector<space::Structure> all_structures() {
    std::vector<space::Structure> all = space::structures();
    for (space::Structure& peer : space::joined({space::ch12::embree(), space::ch12::cgal()}))
        all.push_back(std::move(peer));
    return all;
}

int lab(int argc, char** argv) {
    return space::run_lab(all_structures(), argc, argv);
}

int compare(int argc, char** argv) {
    return space::ch12::run_compare(all_structures(), argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && std::string_view(argv[1]) == "compare")
        return space::run_program("compare", compare, argc - 1, argv + 1);
    return space::run_program("lab", lab, argc, argv);
}
