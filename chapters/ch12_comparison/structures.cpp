/// @file
/// What the lab offers. A chapter adds a file in structures/ and a call here.
#include "chapters/ch12_comparison/structures.hpp"

#include <iterator>
#include <utility>

namespace space {

std::vector<Structure> joined(std::vector<Home> homes) {
    std::vector<Structure> all;
    for (Home& home : homes) {
        home.structures.front().by_default = true;
        for (Structure& structure : home.structures) {
            structure.home = home.name;
            structure.is_peer = home.is_peer;
            all.push_back(std::move(structure));
        }
    }
    return all;
}

// [structures]
// Each in structures/chNN.cpp.
std::vector<Structure> ch01_structures();
std::vector<Structure> ch03_structures();
std::vector<Structure> ch04_structures();
std::vector<Structure> ch05_structures();
std::vector<Structure> ch06_structures();
std::vector<Structure> ch07_structures();
std::vector<Structure> ch08_structures();
std::vector<Structure> ch09_structures();
std::vector<Structure> ch10_structures();

const std::vector<Structure>& structures() {
    static const std::vector<Structure> all = joined({
        {"chapter 1", ch01_structures()},
        {"chapter 3", ch03_structures()},
        {"chapter 4", ch04_structures()},
        {"chapter 5", ch05_structures()},
        {"chapter 6", ch06_structures()},
        {"chapter 7", ch07_structures()},
        {"chapter 8", ch08_structures()},
        {"chapter 9", ch09_structures()},
        {"chapter 10", ch10_structures()},
    });
    return all;
}
// [structures]

}  // namespace space
