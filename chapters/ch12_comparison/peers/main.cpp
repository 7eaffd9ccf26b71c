/// The lab beside other people's structures. Run   lab_with_peers --scene sphereflake --check
/// --against embree
#include "chapters/ch12_comparison/lab.hpp"
#include "chapters/ch12_comparison/peers/peers.hpp"
#include "common/program/error.hpp"

#include <utility>

namespace {

int lab(int argc, char** argv) {
    std::vector<space::Structure> all = space::structures();
    for (space::Structure& peer : space::joined({space::ch12::embree(), space::ch12::cgal()}))
        all.push_back(std::move(peer));
    return space::run_lab(all, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
    return space::run_program("lab", lab, argc, argv);
}
