#include "chapters/ch08_parallel_builds/figures/topology_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <string>
#include <vector>

namespace space::ch08 {
namespace {

using Core = std::vector<const LogicalProcessor*>;  // its threads
using Package = std::map<std::uint32_t, Core>;

constexpr double margin = 16, gap = 10, row_height = 118, cores_in_row = 6, digit = 10.5;
constexpr Ink package_ink = Ink::vermillion, cores_ink = Ink::blue, thread_ink = Ink::green;

std::map<std::uint32_t, Package> packages_of(const MachineView& view) {
    std::map<std::uint32_t, Package> packages;
    for (const LogicalProcessor& each : view.processors)
        packages[each.place.package][each.place.core].push_back(&each);
    for (auto& [id, package] : packages)
        for (auto& [core, threads] : package)
            std::sort(threads.begin(), threads.end(), [](const auto* a, const auto* b) {
                return a->place.thread < b->place.thread;
            });
    return packages;
}

/// As many bits as the widest id of the machine has; one for the package at least. 0 where no id is
/// known.
unsigned bits_of_ids(const MachineView& view) {
    unsigned bits = 0;
    for (const LogicalProcessor& each : view.processors)
        if (each.apic_id)
            bits = std::max(
                {bits, view.fields.package_shift + 1, unsigned(std::bit_width(*each.apic_id))});
    return bits;
}

/// The bits in the colours of their fields, the highest first.
void draw_id(Svg& svg, double centre, double y, std::uint32_t id, unsigned bits,
             ApicIdFields fields) {
    double x = centre - 0.5 * digit * (bits - 1);
    for (unsigned bit = bits; bit-- > 0; x += digit) {
        const Ink ink = bit >= fields.package_shift ? package_ink
                        : bit >= fields.core_shift  ? cores_ink
                                                    : thread_ink;
        svg.text(at(x, y), bits_of(id, bit, bit) ? "1" : "0",
                 {.ink = ink, .size = 17, .bold = true});
    }
}

void draw_core(Svg& svg, double x, double y, double width, std::uint32_t number,
               const Core& threads, const MachineView& view, unsigned bits) {
    using enum LogicalProcessor::Core;
    const auto kind = threads.front()->core;
    svg.rect(at(x, y), at(width, row_height - 26),
             {.stroke = cores_ink, .fill = cores_ink, .opacity = kind == efficiency ? 0.05 : 0.12});
    const char* word = kind == efficiency    ? "slow core"
                       : kind == performance ? "fast core"
                                             : "core";
    svg.text(at(x + width / 2, y + 21), fmt::format("{} {}", word, number),
             {.ink = cores_ink, .size = 17});
    const double share = (width - gap) / double(threads.size());
    for (std::size_t i = 0; i < threads.size(); ++i) {
        const double left = x + gap / 2 + share * double(i) + 2;
        svg.rect(at(left, y + 30), at(share - 4, row_height - 26 - 36),
                 {.stroke = thread_ink, .fill = Ink::paper});
        const double centre = left + (share - 4) / 2;
        svg.text(at(centre, y + 50), fmt::format("{}", threads[i]->number), {.size = 17});
        if (const auto id = threads[i]->apic_id)
            draw_id(svg, centre, y + 76, *id, bits, view.fields);
    }
}

void draw_legend(Svg& svg, double y, const MachineView& view, unsigned bits) {
    if (bits == 0) return;
    const auto [core, package] = view.fields;
    double x = margin;
    const auto part = [&](const std::string& text, Ink ink, double width) {
        svg.text(at(x, y), text, {.anchor = Anchor::start, .ink = ink, .size = 17, .bold = true});
        x += width;
    };
    const auto bits_text = [](unsigned low, unsigned high) {
        return high == low       ? std::string("no bit")
               : high == low + 1 ? fmt::format("bit {}", low)
                                 : fmt::format("bits {} to {}", high - 1, low);
    };
    part(fmt::format("APIC ids of {} bits:", bits), Ink::ink, 210);
    part(fmt::format("package: from bit {}", package), package_ink, 210);
    part(fmt::format("core: {}", bits_text(core, package)), cores_ink, 170);
    part(fmt::format("thread: {}", bits_text(0, core)), thread_ink, 0);
}

}  // namespace

Svg topology_drawing(const MachineView& view) {
    const auto packages = packages_of(view);
    const unsigned bits = bits_of_ids(view);
    std::size_t most_threads = 1, rows = 0, most_cores = 1;
    for (const auto& [id, package] : packages) {
        for (const auto& [core, threads] : package)
            most_threads = std::max(most_threads, threads.size());
        most_cores = std::max(most_cores, package.size());
    }
    const double core_width =
        std::max(110.0, double(most_threads) * (digit * (bits + 1.0) + 8) + gap);
    const std::size_t in_row = std::min<std::size_t>(most_cores, std::size_t(cores_in_row));
    for (const auto& [id, package] : packages) rows += (package.size() + in_row - 1) / in_row;
    const double width = std::max(800.0, 2 * margin + gap + double(in_row) * (core_width + gap));
    const double height =
        40 + double(rows) * (row_height - 26 + gap) + double(packages.size()) * 56 + margin;
    const MachineCounts counts = count_of(view);
    Svg svg(fmt::format("{} packages with {} cores and {} threads{}", counts.packages, counts.cores,
                        counts.threads, bits == 0 ? "" : ", and the bits of their APIC ids"),
            width, height);
    draw_legend(svg, 26, view, bits);
    double y = 44;
    for (const auto& [id, package] : packages) {
        const double package_rows = double((package.size() + in_row - 1) / in_row);
        const double tall = 32 + package_rows * (row_height - 26 + gap);
        svg.rect(at(margin, y), at(width - 2 * margin, tall),
                 {.stroke = package_ink, .fill = package_ink, .opacity = 0.06});
        svg.text(at(margin + gap, y + 22), fmt::format("package {}", id),
                 {.anchor = Anchor::start, .ink = package_ink, .bold = true});
        std::size_t i = 0;
        for (const auto& [core, threads] : package) {
            draw_core(svg, margin + gap + double(i % in_row) * (core_width + gap),
                      y + 32 + double(i / in_row) * (row_height - 26 + gap), core_width, core,
                      threads, view, bits);
            ++i;
        }
        y += tall + 24;
    }
    return svg;
}

}  // namespace space::ch08
