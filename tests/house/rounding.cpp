/// A ray made in double and rounded to float is read back as double. The book's flags must keep the
/// rounding: exit code 0. GCC 12 at -O2 and above drops it, although no flag allows that: its SLP
/// vectoriser makes (double)(float)x of a whole vector into x.
#include <cstdio>

namespace {

struct Float3 {
    float x, y, z;
};
struct Double3 {
    double x, y, z;
};
struct Ray {
    Float3 origin, direction;
    float tmin = 0.0f, tmax = 1.0f;
};

double weighed(const Ray& ray) {
    return 3.0 * double{ray.origin.x} + 5.0 * double{ray.origin.y} + 7.0 * double{ray.origin.z};
}
/// The same out of sight of the code that makes the ray: it can only read floats.
double (*const volatile weighed_elsewhere)(const Ray&) = weighed;

/// Along the line from p in direction q, from parameter s towards parameter t.
[[gnu::noinline]] bool keeps_roundings(const Float3& p, const Float3& q, double s, double t) {
    const Double3 from{p.x + s * q.x, p.y + s * q.y, p.z + s * q.z};
    const Float3 origin{static_cast<float>(from.x), static_cast<float>(from.y),
                        static_cast<float>(from.z)};
    const Double3 target{p.x + t * q.x, p.y + t * q.y, p.z + t * q.z};
    const Ray ray{origin,
                  {static_cast<float>(target.x - double{origin.x}),
                   static_cast<float>(target.y - double{origin.y}),
                   static_cast<float>(target.z - double{origin.z})}};
    const double here = weighed(ray), elsewhere = weighed_elsewhere(ray);
    std::printf("roundings %s: %a, and %a from floats\n", here == elsewhere ? "kept" : "dropped",
                here, elsewhere);
    return here == elsewhere;
}

}  // namespace

int main() {
    volatile double s = -1.3, t = 0.4;  // known at run time only
    return keeps_roundings({0.1f, 0.2f, 0.3f}, {0.7f, 0.6f, 0.9f}, s, t) ? 0 : 1;
}
