// SPDX-License-Identifier: MIT
#include "compare/page/text.h"
#include "compare/tradeoff/tradeoff.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::tradeoff {
namespace {

using page::csvLine;

// All digits; infinity is "inf".
std::string digits(double value) {
    return fmt::format("{}", value);
}

// Options that a sweep can vary. The path has its own column.
std::vector<std::string> optionColumns() {
    std::vector<std::string> options;
    for (const Field& field : settingFields())
        if (!field.sweep.empty() && field.option != "path") options.emplace_back(field.option);
    return options;
}

std::vector<std::string> passNames(const Tradeoff& tradeoff) {
    std::vector<std::string> names;
    for (const TradeoffRow& row : tradeoff.rows)
        for (const PassTime& pass : passesOf(row))
            if (std::ranges::count(names, pass.name) == 0) names.push_back(pass.name);
    return names;
}

std::vector<std::string> head(const std::vector<std::string>& passes) {
    std::vector<std::string> names{"row", "path"};
    for (const std::string& option : optionColumns()) names.push_back(option);
    for (const char* name : {"ms", "ms_min", "ms_max", "runs"}) names.emplace_back(name);
    for (const ErrorFigure& figure : errorFigures)
        for (const char* which : {"", "_min", "_max"}) names.push_back(std::string(figure.name) + which);
    for (const ErrorFigure& figure : errorFigures) names.push_back("front_" + std::string(figure.name));
    for (const ShadowFigure& figure : shadowFigures) names.push_back("shadow_" + std::string(figure.name));
    for (const SampleFigure& figure : sampleFigures) names.push_back("samples_" + std::string(figure.name));
    for (const char* name : {"image_bytes", "buffer_bytes", "gbuffer_bytes_per_pixel"})
        names.emplace_back(name);
    for (const std::string& pass : passes) names.push_back("ms: " + pass);
    for (const char* name : {"warnings", "picture", "measure", "render", "compare"}) names.emplace_back(name);
    return names;
}

}  // namespace

std::string tradeoffCsv(const Tradeoff& tradeoff) {
    const std::vector<std::string> passes = passNames(tradeoff);
    std::array<std::vector<std::size_t>, errorFigures.size()> fronts;
    for (std::size_t f = 0; f < fronts.size(); ++f) fronts[f] = frontOf(tradeoff, f);
    std::string out = csvLine(head(passes));
    for (std::size_t i = 0; i < tradeoff.rows.size(); ++i) {
        const TradeoffRow& row = tradeoff.rows[i];
        std::vector<std::string> fields{fmt::format("{}", i + 1), row.renderer.empty()
                                                                      ? std::string(nameOf(row.settings.path))
                                                                      : row.renderer};
        for (const std::string& option : optionColumns())
            fields.push_back(ignoredBecause(row.settings, option).empty() ? row.settings.valueOf(option)
                                                                          : "");
        const Spread time = timeOf(row);
        for (const double ms : {time.value, time.low, time.high}) fields.push_back(digits(ms));
        fields.push_back(fmt::format("{}", tradeoff.runs));
        for (std::size_t f = 0; f < errorFigures.size(); ++f) {
            const Spread error = errorOf(row, f);
            for (const double value : {error.value, error.low, error.high}) fields.push_back(digits(value));
        }
        for (const auto& front : fronts) fields.emplace_back(std::ranges::count(front, i) > 0 ? "1" : "0");
        const std::optional<ShadowErrors> shadow = shadowOf(row);
        for (std::size_t f = 0; f < shadowFigures.size(); ++f)
            fields.push_back(shadow ? digits((*shadow)[f]) : "");
        const std::optional<SampleShares> samples = samplesOf(row);
        for (std::size_t f = 0; f < sampleFigures.size(); ++f)
            fields.push_back(samples ? digits((*samples)[f]) : "");
        const FrameBytes bytes = bytesOf(row);
        for (const std::uint64_t count : {bytes.images, bytes.buffers, bytes.gbuffer_per_pixel})
            fields.push_back(fmt::format("{}", count));
        const std::vector<PassTime> times = passesOf(row);
        for (const std::string& pass : passes) {
            const auto found = std::ranges::find(times, pass, &PassTime::name);
            fields.push_back(found == times.end() ? "" : digits(found->ms));
        }
        std::string warnings;
        for (const std::string& warning : row.warnings) warnings += (warnings.empty() ? "" : "; ") + warning;
        fields.insert(fields.end(), {warnings, row.picture, measuringCommand(tradeoff, row),
                                     renderingCommand(tradeoff, row), comparingCommand(tradeoff, row)});
        out += csvLine(fields);
    }
    return out;
}

}  // namespace diptych::tradeoff
