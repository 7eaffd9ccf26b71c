#include "common/mesh_reader/triangulate.hpp"

#include <fmt/format.h>
#include <GL/glu.h>

#include <cmath>
#include <cstdint>
#include <memory>

#if defined(__SANITIZE_ADDRESS__)
#define BOOK_SEES_LEAKS
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define BOOK_SEES_LEAKS
#endif
#endif
#ifdef BOOK_SEES_LEAKS
#include <sanitizer/lsan_interface.h>
#endif

namespace space::mesh_reader {
namespace {

/// Twice the signed area of a, b, c seen against an axis.
double turn(const Double3& a, const Double3& b, const Double3& c, int axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    return (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
}

int main_axis(const Double3& v) {
    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (std::abs(v[other]) > std::abs(v[axis])) axis = other;
    return axis;
}

/// A face as it is seen along the axis that its normal is nearest to.
struct Outline {
    const Polygons& polygons;
    std::span<const std::uint32_t> corners;
    int axis = 0;
    double sign = 1.0;  ///< of the area that it shows

    Outline(const Polygons& all, std::size_t face);
    const Double3& at(std::size_t i) const { return polygons.points[corners[i]]; }
    double left(std::size_t a, std::size_t b, std::size_t c) const {
        return sign * turn(at(a), at(b), at(c), axis);
    }
    bool is_fan() const;
};

/// Newell's normal; an outline whose parts cancel, such as an 8, is seen from where they are large.
Outline::Outline(const Polygons& all, std::size_t face) : polygons(all), corners(all[face]) {
    if (corners.size() == 3) return;
    Double3 area{0.0}, parts{0.0};
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const Double3 part = glm::cross(at(i - 1) - at(0), at(i) - at(0));
        area += part;
        parts += glm::abs(part);
    }
    constexpr double negligible = 1e-9;
    axis = main_axis(area);
    if (std::abs(area[axis]) <= negligible * parts[main_axis(parts)]) axis = main_axis(parts);
    if (area[axis] < 0.0) sign = -1.0;
}

/// Does the first corner see all others in their order within a half-turn? An outline that comes
/// back to the first corner must go on where it was.
bool Outline::is_fan() const {
    std::size_t last = 0;  // of the corners that lie elsewhere than the first
    for (std::size_t i = 1; i < corners.size(); ++i) {
        if (left(0, last, i) < 0.0 || left(0, 1, i) < 0.0) return false;
        if (at(i) != at(0)) last = i;
    }
    return true;
}

/// GLU's tessellator (SGI's, by Eric Veach: a sweep line) takes the faces that are no fan. It works
/// in double precision, needs no window, and merges corners at one place.
class Tessellator {
  public:
    explicit Tessellator(Polygons& polygons);
    /// The corners of the triangles, three by three; none of use where there are too many
    /// crossings.
    const std::vector<std::uint32_t>& cut(const Outline& outline);
    /// Of the last outline with itself.
    std::size_t crossings() const { return crossings_; }

    /// Of a face. n corners may make n^2 / 2 of them, which would take minutes for n = 2000.
    static constexpr std::size_t most_crossings = 1000;

  private:
    /// An index travels through the tessellator as a pointer, which must not be null.
    static void* as_pointer(std::size_t index) { return reinterpret_cast<void*>(index + 1); }
    static std::uint32_t as_index(void* pointer) {
        return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(pointer) - 1);
    }
    struct GiveUp {};
    static void on_vertex(void* index, Tessellator* self) {
        self->corners_.push_back(as_index(index));
    }
    static void on_combine(double place[3], void* indices[4], float weights[4], void** made,
                           Tessellator* self);

    struct Delete {
        void operator()(GLUtesselator* tessellator) const { gluDeleteTess(tessellator); }
    };
    std::unique_ptr<GLUtesselator, Delete> tessellator_{gluNewTess()};
    Polygons& polygons_;
    std::vector<std::uint32_t> corners_ = {};
    std::size_t crossings_ = 0;
};

Tessellator::Tessellator(Polygons& polygons) : polygons_(polygons) {
    GLUtesselator* const glu = tessellator_.get();
    gluTessProperty(glu, GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_ODD);
    gluTessCallback(glu, GLU_TESS_VERTEX_DATA, reinterpret_cast<_GLUfuncptr>(on_vertex));
    gluTessCallback(glu, GLU_TESS_COMBINE_DATA, reinterpret_cast<_GLUfuncptr>(on_combine));
    // Who listens to edges gets triangles only, no fans and strips.
    gluTessCallback(glu, GLU_TESS_EDGE_FLAG, reinterpret_cast<_GLUfuncptr>(+[](GLboolean) {}));
}

/// Two corners at one place become the first of them; where two edges cross, with four ends, a
/// vertex is made.
void Tessellator::on_combine(double place[3], void* indices[4], float[4], void** made,
                             Tessellator* self) {
    *made = indices[0];
    if (!indices[2]) return;
    if (++self->crossings_ > most_crossings) throw GiveUp{};
    *made = as_pointer(self->polygons_.points.size());
    self->polygons_.points.push_back({place[0], place[1], place[2]});
}

const std::vector<std::uint32_t>& Tessellator::cut(const Outline& outline) {
    GLUtesselator* const glu = tessellator_.get();
    crossings_ = 0;
    corners_.clear();
    Double3 normal{0.0};
    normal[outline.axis] = outline.sign;
    gluTessNormal(glu, normal.x, normal.y, normal.z);
    gluTessBeginPolygon(glu, this);
    gluTessBeginContour(glu);
    for (std::size_t i = 0; i < outline.corners.size(); ++i) {
        Double3 place = outline.at(i);
        gluTessVertex(glu, &place[0], as_pointer(outline.corners[i]));
    }
    gluTessEndContour(glu);
    try {
#ifdef BOOK_SEES_LEAKS
        const __lsan::ScopedDisabler what_it_loses;
#endif
        gluTessEndPolygon(glu);
    } catch (const GiveUp&) {  // it loses some memory then, and is not used again
    }
    return corners_;
}

/// What most faces are: triangles, fans, and quadrilaterals with a corner that points inwards.
/// False for all others.
bool cut_simply(const Outline& outline, std::vector<std::array<std::uint32_t, 3>>& faces) {
    const std::span<const std::uint32_t> corner = outline.corners;
    if (corner.size() == 3 || outline.is_fan()) {
        for (std::size_t i = 2; i < corner.size(); ++i)
            faces.push_back({corner[0], corner[i - 1], corner[i]});
        return true;
    }
    if (corner.size() != 4 || outline.left(3, 0, 1) <= 0.0 || outline.left(1, 2, 3) <= 0.0)
        return false;
    faces.push_back({corner[3], corner[0], corner[1]});
    faces.push_back({corner[1], corner[2], corner[3]});
    return true;
}

}  // namespace

TriangleMesh triangulate(const Source& source, Polygons polygons) {
    TriangleMesh mesh;
    Tessellator tessellator(polygons);
    std::size_t crossed = 0, empty = 0;
    mesh.faces.reserve(polygons.size());
    for (std::size_t face = 0; face < polygons.size(); ++face) {
        const Outline outline(polygons, face);
        if (cut_simply(outline, mesh.faces)) continue;
        const std::vector<std::uint32_t>& corners = tessellator.cut(outline);
        if (tessellator.crossings() > Tessellator::most_crossings)
            source.fail(fmt::format("face {} crosses itself more than {} times", face,
                                    Tessellator::most_crossings));
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            mesh.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
        crossed += tessellator.crossings() > 0;
        empty += corners.empty();
    }
    if (crossed > 0)
        mesh.remarks.push_back((crossed == 1 ? "1 face crosses itself"
                                             : fmt::format("{} faces cross themselves", crossed)) +
                               ": cut by the even-odd rule");
    if (empty > 0)
        mesh.remarks.push_back((empty == 1 ? "1 face encloses nothing"
                                           : fmt::format("{} faces enclose nothing", empty)) +
                               ": left out");
    mesh.vertices.reserve(polygons.points.size());
    for (const Double3& point : polygons.points) mesh.vertices.push_back(Point3(point));
    return mesh;
}

}  // namespace space::mesh_reader
