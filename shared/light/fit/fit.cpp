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

// Directions a side of the square: of the search, of the error that is stored (a tenth of a percent of it),
// and of the albedo (1e-4).
constexpr int searched = 32, stored = 96, counted = 192;

LtcCell cellOf(const Point<3>& x) {
    LtcCell cell;
    cell.in_plane = static_cast<float>(std::exp(x[0]));
    cell.across = static_cast<float>(std::exp(x[1]));
    cell.unsheared = static_cast<float>(x[2]);
    return cell;
}

}  // namespace

Lobe lobeOf(std::size_t i, std::size_t j) {
    const double x = static_cast<double>(i) / (cells - 1), y = static_cast<double>(j) / (cells - 1);
    const double roughness = std::lerp(double{gpu::MIN_PERCEPTUAL_ROUGHNESS}, 1.0, x);
    return {roughness * roughness, std::max((1 - y) * (1 - y), double{gpu::MIN_N_DOT_V})};
}

LtcCell fitCell(const Lobe& lobe, const LtcCell& start) {
    const Albedo albedo = albedoOf(lobe, counted);
    const auto transform = [&](const LtcCell& cell) { return transformOf(cell, lobe.alpha(), lobe.nDotV()); };
    const auto apart = [&](const Point<3>& x) {
        return distance(lobe, albedo.magnitude, transform(cellOf(x)), searched);
    };
    Point<3> x{std::log(double{start.in_plane}), std::log(double{start.across}), double{start.unsheared}};
    // Twice: a simplex that has collapsed too early opens again.
    for (const double step : {0.1, 0.02}) x = nelderMead<3>(apart, x, step, 1e-6, 200);
    LtcCell cell = cellOf(x);
    cell.magnitude = static_cast<float>(albedo.magnitude);
    cell.fresnel = static_cast<float>(albedo.fresnel);
    cell.error = static_cast<float>(distance(lobe, albedo.magnitude, transform(cell), stored));
    return cell;
}

LtcTable fitTable(const std::function<void(double)>& progress) {
    LtcTable table;
    table.cells.resize(cells * cells);
    std::atomic<std::size_t> done = 0;
    const auto fit = [&](std::size_t i, std::size_t j, const LtcCell& start) {
        LtcCell& cell = table.cells[j * cells + i];
        cell = fitCell(lobeOf(i, j), start);
        progress(static_cast<double>(++done) / static_cast<double>(table.cells.size()));
    };
    for (std::size_t i = cells; i-- > 0;) {
        fit(i, 0, i + 1 < cells ? table.cell(i + 1, 0) : LtcCell{});
        // Seen from the normal a lobe is round, and whatever its shear is multiplied by 0: near what comes
        // next.
        LtcCell& round = table.cells[i];
        round.in_plane = round.across = std::sqrt(round.in_plane * round.across);
        round.unsheared = static_cast<float>(lobeOf(i, 0).alpha());
    }
    tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t i) {
        for (std::size_t j = 1; j < cells; ++j) fit(i, j, table.cell(i, j - 1));
        table.cells[i].unsheared = table.cell(i, 1).unsheared;
    });
    return table;
}

}  // namespace diptych::ltc
