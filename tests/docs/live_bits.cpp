/// Prints what the module of the live figures is to answer, too. Run   live_bits SEED RAYS
#include "common/program/error.hpp"
#include "docs/live/same_bits.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace {

int live_bits(int argc, char** argv) {
    using namespace space;
    if (argc != 3) throw usage_error("give: a seed, and how many rays");
    const auto number = [&](int i) { return static_cast<std::uint32_t>(std::stoul(argv[i])); };
    fmt::print("{}", live::same_bits(number(1), number(2)));
    return static_cast<int>(ExitCode::ok);
}

}  // namespace

int main(int argc, char** argv) {
    return space::run_program("live_bits", live_bits, argc, argv);
}
