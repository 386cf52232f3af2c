// SPDX-License-Identifier: MIT
#include "compare/tradeoff/sample_figures.h"

#include "shared/contract/debug_mode.h"

#include <algorithm>

namespace diptych::tradeoff {

std::optional<Settings> exactEdges(const Settings& settings) {
    if (!hasGBuffer(settings.path) || settings.msaa == 1) return {};
    Settings exact = settings;
    exact.msaa_edges = MsaaEdges::exact;
    return exact;
}

std::optional<SampleShares> sampleSharesOf(const Frame& exact, const Frame& frame) {
    const auto find = [](const Frame& of, Channel mode) {
        const auto found = of.channels.find(mode);
        return found == of.channels.end() ? nullptr : &found->second;
    };
    const Image *lit = find(frame, Channel::lit), *exact_lit = find(exact, Channel::lit),
                *shaded = find(frame, Channel::shaded_samples),
                *exact_shaded = find(exact, Channel::shaded_samples);
    if (!lit || !exact_lit || !shaded || !exact_shaded || lit->pixels() != exact_lit->pixels()) return {};
    double pixels = 0, surfaces = 0, edges = 0, differing = 0, elsewhere = 0;
    for (std::size_t i = 0; i < lit->pixels(); ++i) {
        const float count = shaded->pixel(i)[0];
        if (!(count > 0)) continue;
        ++pixels;
        surfaces += double{count};
        edges += count > 1;
        const bool differs = !std::equal(lit->pixel(i), lit->pixel(i) + lit->components, exact_lit->pixel(i));
        differing += differs;
        elsewhere += differs && count >= exact_shaded->pixel(i)[0];
    }
    if (pixels == 0) return SampleShares{};
    return SampleShares{surfaces / pixels, edges / pixels, differing / pixels, elsewhere / pixels};
}

FigureTable sampleTable(const Tradeoff& tradeoff) {
    FigureTable table{"Samples that deferred lighting shades",
                      "With multisampling, --msaa-edges selects the samples of a pixel that are shaded "
                      "separately. Exact shades each sample that differs in any G-buffer bit, so its picture "
                      "is that of all samples. The other modes are compared with exact.",
                      figureHead(Measure::shaded, Measure::elsewhere)};
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i)
        if (tradeoff.rows[i].measured.has(Measure::shaded))
            table.table.rows.push_back(
                figureRow(tradeoff, i, "msaa-edges", Measure::shaded, Measure::elsewhere));
    return table;
}

}  // namespace diptych::tradeoff
