// SPDX-License-Identifier: MIT
#include "shared/light/fit/fit.h"

#include "shared/contract/constants.h"
#include "shared/light/fit/nelder_mead.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace diptych::ltc {
namespace {

constexpr std::size_t cells = gpu::LTC_CELLS;

// Directions per side of the square: for the search, for the stored error (precise to 0.1 % of it), and
// for the albedo (precise to 1e-4).
constexpr int searched = 32, stored = 96, counted = 192;

LtcLobe parametersOf(const Point<4>& x) {
    return {.in_plane = static_cast<float>(std::exp(x[0])),
            .across = static_cast<float>(std::exp(x[1])),
            .unsheared = static_cast<float>(x[2]),
            .tilt = static_cast<float>(x[3])};
}

// `all`: integral of the lobe.
LtcLobe fitLobe(const Lobe& lobe, double all, const LtcLobe& start) {
    const auto transform = [&](const LtcLobe& l) { return transformOf(l, lobe.alpha(), lobe.nDotV()); };
    const auto apart = [&](const Point<4>& x) {
        return distance(lobe, all, transform(parametersOf(x)), searched);
    };
    Point<4> x{std::log(double{start.in_plane}), std::log(double{start.across}), double{start.unsheared},
               double{start.tilt}};
    // Several searches: a simplex that collapsed too early expands again.
    for (const double step : {0.1, 0.05, 0.02}) x = nelderMead<4>(apart, x, step, 1e-6, 300);
    LtcLobe fitted = parametersOf(x);
    fitted.error = static_cast<float>(distance(lobe, all, transform(fitted), stored));
    return fitted;
}

}  // namespace

Lobe lobeOf(std::size_t i, std::size_t j, double f0) {
    const double x = static_cast<double>(i) / (cells - 1), y = static_cast<double>(j) / (cells - 1);
    const double roughness = std::lerp(double{gpu::MIN_PERCEPTUAL_ROUGHNESS}, 1.0, x);
    return {roughness * roughness, std::max((1 - y) * (1 - y), double{gpu::MIN_N_DOT_V}), f0};
}

LtcCell fitCell(std::size_t i, std::size_t j, const LtcCell& start) {
    constexpr double f0{gpu::LTC_LAYER_F0};
    const Lobe even = lobeOf(i, j);
    const Albedo albedo = albedoOf(even, counted);
    LtcCell cell;
    cell.magnitude = static_cast<float>(albedo.magnitude);
    cell.fresnel = static_cast<float>(albedo.fresnel);
    cell.even = fitLobe(even, albedo.magnitude, start.even);
    cell.layer = fitLobe(lobeOf(i, j, f0), f0 * albedo.magnitude + (1 - f0) * albedo.fresnel, start.layer);
    return cell;
}

LtcTable fitTable(const std::function<void(double)>& progress) {
    LtcTable table;
    table.cells.resize(cells * cells);
    std::atomic<std::size_t> done = 0;
    const auto fit = [&](std::size_t i, std::size_t j, const LtcCell& start) {
        LtcCell& cell = table.cells[j * cells + i];
        cell = fitCell(i, j, start);
        progress(static_cast<double>(++done) / static_cast<double>(table.cells.size()));
    };
    for (std::size_t i = cells; i-- > 0;) {
        fit(i, 0, i + 1 < cells ? table.cell(i + 1, 0) : LtcCell{});
        // At normal incidence a lobe is round, and its shear is multiplied by 0, so any value serves. This
        // one is close to the next cell's.
        for (LtcLobe* round : {&table.cells[i].even, &table.cells[i].layer}) {
            round->in_plane = round->across = std::sqrt(round->in_plane * round->across);
            round->unsheared = static_cast<float>(lobeOf(i, 0).alpha());
            round->tilt = 0;
        }
    }
    tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t i) {
        for (std::size_t j = 1; j < cells; ++j) fit(i, j, table.cell(i, j - 1));
        table.cells[i].even.unsheared = table.cell(i, 1).even.unsheared;
        table.cells[i].layer.unsheared = table.cell(i, 1).layer.unsheared;
    });
    return table;
}

}  // namespace diptych::ltc
