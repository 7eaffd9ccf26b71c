#include "chapters/ch11_sampling_and_caching/measured/density.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace space::ch11 {
namespace {

Table densities_table(const std::vector<DensityPoint>& points) {
    Table table({"k", "k over the disc", "k / (k - 1)", "k - 1 over the disc", "spread",
                 "1 / root(k - 2)"});
    for (const DensityPoint& p : points)
        table.row({with_commas(p.k), fixed(p.all_of_k, 2), fixed(double(p.k) / double(p.k - 1), 2),
                   fixed(p.less_one, 2), fixed(p.spread, 2),
                   fixed(1.0 / std::sqrt(double(p.k) - 2.0), 2)});
    return table;
}

Table photon_leaks_table(const std::vector<PhotonLeakPoint>& points) {
    Table table({"place", "exact", "as printed", "k - 1, own surface only"});
    for (const PhotonLeakPoint& p : points)
        table.row(
            {std::string(p.place), fixed(p.exact, 0), fixed(p.plain, 2), fixed(p.own_surface, 2)});
    return table;
}

Table photons_table(const std::vector<PhotonCountPoint>& points) {
    Table table({"scene", "emitted", "stored, direct", "caustic", "indirect", "aimed",
                 "stored of these", "bytes a photon"});
    for (const PhotonCountPoint& p : points)
        table.row({p.scene, with_commas(p.emitted), with_commas(p.direct), with_commas(p.caustic),
                   with_commas(p.indirect), with_commas(p.aimed), with_commas(p.aimed_stored),
                   fixed(p.bytes, 0)});
    return table;
}

Table cache_leaks_table(const std::vector<CacheLeakPoint>& points) {
    Table table({"records", "number", "pixels of the dark room", "of these lit",
                 "light there, lit room = 1"});
    for (const CacheLeakPoint& p : points)
        table.row({std::string(p.way), with_commas(p.records), with_commas(p.pixels),
                   with_commas(p.lit), p.leak == 0.0 ? "0" : fmt::format("{:.2g}", p.leak)});
    return table;
}

Table records_table(const std::vector<CacheCountPoint>& points) {
    Table table({"accuracy", "pixels", "records, constant", "with gradients"});
    for (const CacheCountPoint& p : points)
        table.row({fmt::format("{}", p.accuracy), with_commas(p.pixels), with_commas(p.constant),
                   with_commas(p.gradients)});
    return table;
}

}  // namespace

void print_density(const DensityMeasurements& measured) {
    print_heading("Even light from the k nearest photons; the true value is 1");
    densities_table(measured.densities).print();
    print_heading("Irradiance by photons, k = 50");
    photon_leaks_table(measured.photon_leaks).print();
    print_heading("Photons");
    photons_table(measured.photons).print();
    print_heading("A cache beside a thin wall");
    cache_leaks_table(measured.cache_leaks).print();
    print_heading("Records of the interior");
    records_table(measured.records).print();
}

void quote_density(const DensityMeasurements& measured, Numbers& numbers) {
    numbers.count_table("k_minus_one", densities_table(measured.densities));
    numbers.count_table("photon_leaks", photon_leaks_table(measured.photon_leaks));
    numbers.count_table("photons", photons_table(measured.photons));
    numbers.count_table("cache_leaks", cache_leaks_table(measured.cache_leaks));
    numbers.count_table("cache_records", records_table(measured.records));
    const double bytes = measured.photons.front().bytes;
    numbers.count("photon_bytes", bytes, fixed(bytes, 0));
}

std::uint64_t wrong_density(const DensityMeasurements& measured) {
    std::uint64_t wrong = 0;
    for (const PhotonCountPoint& p : measured.photons) wrong += p.lost;
    return wrong;
}

}  // namespace space::ch11
