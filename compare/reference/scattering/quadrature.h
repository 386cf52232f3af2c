// SPDX-License-Identifier: MIT
// Adaptive integration over a rectangle of two parameters.
#pragma once

#include "compare/reference/scattering/surface.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace diptych::reference {

struct Cell {
    double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
    double area() const { return (u1 - u0) * (v1 - v0); }
    std::array<Cell, 4> quarters() const {
        const double u = (u0 + u1) / 2, v = (v0 + v1) / 2;
        return {{{u0, u, v0, v}, {u, u1, v0, v}, {u0, u, v, v1}, {u, u1, v, v1}}};
    }
    std::array<Cell, 2> halves(bool across_u) const {
        const double u = (u0 + u1) / 2, v = (v0 + v1) / 2;
        if (across_u) return {{{u0, u, v0, v1}, {u, u1, v0, v1}}};
        return {{{u0, u1, v0, v}, {u0, u1, v, v1}}};
    }
};

struct Integral {
    Reflected value;
    // Error of value.size(): differences that remained at the limit on cells or depth.
    double error = 0;
};

// Gauss-Legendre quadrature with 5 x 5 points: exact for polynomials up to degree 9 in each parameter.
template <class Integrand>
Reflected gauss(const Integrand& f, const Cell& cell) {
    constexpr std::array<double, 5> node{-0.906179845938663993, -0.538469310105683091, 0,
                                         0.538469310105683091, 0.906179845938663993};
    constexpr std::array<double, 5> weight{0.236926885056189088, 0.478628670499366468, 0.568888888888888889,
                                           0.478628670499366468, 0.236926885056189088};
    const double u = (cell.u0 + cell.u1) / 2, du = (cell.u1 - cell.u0) / 2;
    const double v = (cell.v0 + cell.v1) / 2, dv = (cell.v1 - cell.v0) / 2;
    Reflected sum;
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t j = 0; j < 5; ++j)
            sum += f(u + du * node[i], v + dv * node[j]) * (weight[i] * weight[j]);
    return sum * (du * dv);
}

// Whether, and in which direction, a cell must be split before the integrand is evaluated. Otherwise a
// narrow lobe between the points of a cell would be missed.
enum class Split { none, u, v };

// Splits a cell into quarters until the sum of their integrals is within tolerance of its own integral.
// The tolerance is `relative` times the whole integral, halved at every level. `mustSplit(cell)` returns a
// Split. `leaves`, if given, receives the final cells and their integrals.
struct Leaf {
    Cell cell;
    Reflected value;
};
template <class Integrand, class MustSplit>
class Quadrature {
public:
    Quadrature(const Integrand& f, const MustSplit& mustSplit, double relative, std::vector<Leaf>* leaves)
        : f_(f), must_split_(mustSplit), relative_(relative), leaves_(leaves) {}

    Integral operator()() {
        scout({}, 0);
        double whole = 0;
        {
            Reflected sum;
            for (const Leaf& leaf : start_) sum += leaf.value;
            whole = sum.size();
        }
        for (std::size_t i = 0; i < start_.size(); ++i) refine(start_[i], relative_ * whole, 0);
        return result_;
    }

private:
    static constexpr int deepest = 24;
    static constexpr std::size_t max = 20000;  // cells

    void scout(const Cell& cell, int depth) {
        const Split split = depth < 2 * deepest && start_.size() < max / 4 ? must_split_(cell) : Split::none;
        if (split != Split::none) {
            for (const Cell& half : cell.halves(split == Split::u)) scout(half, depth + 1);
            return;
        }
        start_.push_back({cell, gauss(f_, cell)});
    }

    void refine(const Leaf& leaf, double tolerance, int depth) {
        const std::array<Cell, 4> quarters = leaf.cell.quarters();
        std::array<Leaf, 4> parts;
        Reflected sum;
        for (std::size_t i = 0; i < 4; ++i) {
            parts[i] = {quarters[i], gauss(f_, quarters[i])};
            sum += parts[i].value;
        }
        cells_ += 4;
        const double apart = (leaf.value - sum).size();
        if (apart <= tolerance || depth >= deepest || cells_ >= max) {
            if (!(apart <= tolerance)) result_.error += apart;
            result_.value += sum;
            if (leaves_) leaves_->push_back({leaf.cell, sum});
            return;
        }
        for (const Leaf& part : parts) refine(part, tolerance / 2, depth + 1);
    }

    const Integrand& f_;
    const MustSplit& must_split_;
    const double relative_;
    std::vector<Leaf>* const leaves_;
    std::vector<Leaf> start_;
    std::size_t cells_ = 0;
    Integral result_;
};

}  // namespace diptych::reference
