// SPDX-License-Identifier: MIT
// One row of a sweep: one Settings, from every camera.
#pragma once

#include "compare/experiment/row.h"

#include <nlohmann/json.hpp>

#include <string>

namespace diptych::tradeoff {

using experiment::errorFigures;
using experiment::Errors;
using experiment::Measure;
using experiment::sampleFigures;
using experiment::SampleShares;
using experiment::ShadowErrors;
using experiment::shadowFigures;
using experiment::Spread;

// The measure of an error, an index in errorFigures.
constexpr Measure errorMeasure(std::size_t figure) {
    return Measure::flip + figure;
}

// Settings: from the first camera. Times of another renderer are those of its whole command, so fronts and
// plots skip its rows.
struct TradeoffRow : experiment::Row {
    double drawing_ms = 0;     // wall-clock time of rendering and timing
    std::string picture{};     // file name
    std::string errors_map{};  // file name of the FLIP image
};

nlohmann::ordered_json jsonOf(const TradeoffRow& row);
// Reads the output of jsonOf(). Throws std::runtime_error naming the place of an error.
TradeoffRow tradeoffRowFrom(const nlohmann::ordered_json& json);

}  // namespace diptych::tradeoff
