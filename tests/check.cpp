#include "tests/check.hpp"

#include <fmt/format.h>

namespace space {

std::string shortest(float number) {
    return fmt::format("{}", number);
}
std::string shortest(double number) {
    return fmt::format("{}", number);
}

}  // namespace space

namespace Catch {

std::string StringMaker<space::Triangle>::convert(const space::Triangle& triangle) {
    return Detail::stringify(triangle.a) + " " + Detail::stringify(triangle.b) + " " +
           Detail::stringify(triangle.c);
}

std::string StringMaker<space::Segment>::convert(const space::Segment& segment) {
    return Detail::stringify(segment.a) + " " + Detail::stringify(segment.b);
}

std::string StringMaker<space::Hit>::convert(const space::Hit& hit) {
    return fmt::format("triangle {} at t = {} (u = {}, v = {})", hit.triangle, hit.t, hit.u, hit.v);
}

std::string StringMaker<std::optional<space::Hit>>::convert(const std::optional<space::Hit>& hit) {
    return hit ? Detail::stringify(*hit) : "no hit";
}

std::string StringMaker<space::Error>::convert(const space::Error& error) {
    int digits = 2;  // and as many more as tell the two numbers apart
    const auto text = [&](double x) { return fmt::format("{:.{}g}", x, digits); };
    while (digits < 17 && error.is != error.allowed && text(error.is) == text(error.allowed))
        ++digits;
    return fmt::format("{} (allowed {})", text(error.is), text(error.allowed));
}

}  // namespace Catch
