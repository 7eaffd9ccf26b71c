/// @file
/// Pairs of a simplex and a cell on which an overlap test may fail: many that only touch, some
/// apart by one float, some without area.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/random.hpp"

#include <cmath>
#include <cstdint>

namespace space {

template <int D>
struct OverlapPair {
    Simplex<D> simplex;
    OrthtreeBox<D> cell;
};

template <int D>
class PairMaker {
  public:
    explicit PairMaker(std::uint64_t seed) : random_(seed, D) {}

    OverlapPair<D> next() {
        OrthtreeFrame<D> frame;
        // Cells of a frame far from 0 have corners that no float is.
        if (random_.below(4) == 0)
            frame = OrthtreeFrame<D>::around(
                {Point<D>(1000.1f), Point<D>(1000.1f) + random_point(random_, unit())});
        OrthtreeCell<D> cell{random_.below(random_.below(3) ? 4 : max_orthtree_depth<D>), {}};
        for (std::uint32_t& place : cell.place) place = random_.below(1u << cell.depth);
        cell_ = frame.box(cell);
        edge_ = float(frame.cell_edge(cell.depth));
        OverlapPair<D> pair{{}, cell_};
        switch (random_.below(6)) {
            case 5:
                return too_near_for_doubles();
            case 0:  // anywhere near
                for (int i = 0; i < D; ++i) corner(pair.simplex, i) = near();
                break;
            case 1:  // on the lattice of the cell's corners and middles
                for (int i = 0; i < D; ++i) corner(pair.simplex, i) = lattice();
                break;
            default:  // through points on the cell's surface
                for (int i = 0; i < D; ++i) corner(pair.simplex, i) = near();
                aim(pair.simplex);
                if (D == 3 && random_.below(2) == 0) aim(pair.simplex);
        }
        if (random_.below(3) == 0) nudge(pair.simplex);
        if (random_.below(8) == 0) corner(pair.simplex, 0) = pair.simplex[1];
        return pair;
    }

  private:
    static BasicAabb<D> unit() { return {Point<D>(0.0f), Point<D>(1.0f)}; }
    /// The unit cell, and a simplex that passes its corner 0 at less than doubles can tell: what
    /// decides is lost when differences and products are rounded.
    OverlapPair<D> too_near_for_doubles() {
        OverlapPair<D> pair{{}, OrthtreeFrame<D>{}.box()};
        const auto number = [&] { return random_.uniform(0.25f, 1.5f); };
        const auto speck = [&] { return std::ldexp(random_.uniform(-1.0f, 1.0f), -58); };
        if (D == 3 && random_.below(2) == 0) {  // a plane through it, but for specks
            for (int i = 0; i < D; ++i) {
                const float r = number();
                Point<D>& p = corner(pair.simplex, i);
                p[i] = r;
                p[(i + 1) % D] = -r;
                p[(i + D - 1) % D] = speck();
            }
            return pair;
        }
        // An edge from (-1, y) past (0, 0) to a point near it: x y + y' is nearly 0.
        const int j = int(random_.below(D)), k = (j + 1) % D;
        for (int i = 0; i < D; ++i) corner(pair.simplex, i) = Point<D>(number());
        Point<D>&a = corner(pair.simplex, 0), &b = corner(pair.simplex, 1);
        a[j] = -1.0f;
        b[j] = std::ldexp(a[k], -30);
        a[k] = number();
        b[k] = -b[j] * a[k];
        if (D == 3) corner(pair.simplex, D - 1)[j] = corner(pair.simplex, D - 1)[k] = -2.0f;
        return pair;
    }
    static Point<D>& corner(Simplex<D>& simplex, int i) {
        if constexpr (D == 3)
            if (i == 2) return simplex.c;
        return i == 0 ? simplex.a : simplex.b;
    }
    Point<D> near() {
        const float reach = random_.below(3) ? 1.5f : 20.0f;
        return Point<D>(cell_.centre()) +
               edge_ * random_point(random_, BasicAabb<D>{Point<D>(-reach), Point<D>(reach)});
    }
    Point<D> lattice() {
        Point<D> p(cell_.min);
        for (int axis = 0; axis < D; ++axis)
            p[axis] += edge_ * 0.5f * (float(random_.below(9)) - 3.0f);
        return p;
    }
    /// A point of the cell's surface: on a face, an edge, or a corner.
    Point<D> touch() {
        Point<D> p(cell_.min);
        for (int axis = 0; axis < D; ++axis) {
            const std::uint32_t where = random_.below(4);
            p[axis] = where == 0   ? float(cell_.min[axis])
                      : where == 1 ? float(cell_.max[axis])
                                   : p[axis] + edge_ * 0.25f * float(1 + random_.below(3));
        }
        return p;
    }
    /// Moves two corners so that the edge between them goes through a point of the surface.
    void aim(Simplex<D>& simplex) {
        const int i = int(random_.below(D)), j = (i + 1) % D;
        const Point<D> through = touch();
        // Whole quarters of the cell's edge: what is added and taken away is mostly exact.
        Vector<D> way = random_point(random_, BasicAabb<D>{Point<D>(-8.0f), Point<D>(8.0f)});
        if (random_.below(2)) way = glm::round(way);
        way *= edge_ * 0.25f;
        corner(simplex, i) = through + way;
        corner(simplex, j) = random_.below(4) ? through - way * float(random_.below(4)) : through;
    }
    void nudge(Simplex<D>& simplex) {
        Point<D>& p = corner(simplex, int(random_.below(D)));
        float& x = p[int(random_.below(D))];
        x = std::nextafter(x, random_.below(2) ? infinity : -infinity);
    }

    Pcg32 random_;
    OrthtreeBox<D> cell_{};
    float edge_ = 1.0f;
};

}  // namespace space
