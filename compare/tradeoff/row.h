// SPDX-License-Identifier: MIT
// The measurements of one row of a sweep: one Settings.
#pragma once

#include "compare/tradeoff/sample_shares.h"
#include "compare/tradeoff/shadow_errors.h"
#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych::tradeoff {

// Of lit against the reference, over the pixels that show a surface there: the same for every row.
struct ErrorFigure {
    std::string_view name, title, means;
};
inline constexpr std::array errorFigures{
    ErrorFigure{"flip", "FLIP", "mean HDR-FLIP, 0 to 1"},
    ErrorFigure{"relative_rmse", "relative RMSE", "root mean square of the relative error"},
    ErrorFigure{"relative_p99", "relative p99", "99th percentile of the relative error, nearest rank"},
};
using Errors = std::array<double, errorFigures.size()>;

struct CameraRow {
    std::string camera;             // its title: "default view"
    std::vector<FrameTime> visits;  // one entry per series of timed frames
    std::vector<PassTime> passes;
    FrameBytes bytes;
    Errors errors{};
    std::uint64_t pixels = 0;  // that the errors are over
    std::optional<ShadowErrors> shadow{};
    std::optional<SampleShares> samples{};
};

struct TradeoffRow {
    Settings settings;  // its camera is the first one
    std::vector<CameraRow> cameras;
    Errors errors{};           // of all cameras' pixels together
    double drawing_ms = 0;     // wall clock of drawing and timing
    std::string picture{};     // its file
    std::string errors_map{};  // file of the picture of FLIP
    std::vector<std::string> warnings{};
    // Of another renderer its name and its file; such a row's time is its whole command's, so that it stands
    // on no front and in no plot.
    std::string renderer{}, renderer_file{};
};

// Over all visits: the mean of their medians, so that each visit counts equally; the least and greatest time;
// the number of all frames.
FrameTime timeOf(const CameraRow& camera);

struct Spread {
    double value = 0, low = 0, high = 0;
};
// The mean over cameras of the medians, of the least and of the greatest times, ms.
Spread timeOf(const TradeoffRow& row);
// The error over all cameras together, and the least and greatest of a single camera.
Spread errorOf(const TradeoffRow& row, std::size_t figure);
// The mean over cameras, ms; names in the first camera's order.
std::vector<PassTime> passesOf(const TradeoffRow& row);
// The bytes of the camera that takes most, and the sum of its images and buffers.
FrameBytes bytesOf(const TradeoffRow& row);
std::uint64_t memoryOf(const TradeoffRow& row);
// The mean over the cameras; nothing where one of them has none.
std::optional<ShadowErrors> shadowOf(const TradeoffRow& row);
std::optional<SampleShares> samplesOf(const TradeoffRow& row);

// Every number with all its digits; an error that is infinite is null.
nlohmann::ordered_json jsonOf(const TradeoffRow& row);
// Reads what jsonOf() wrote; throws std::runtime_error that names the place if it is anything else.
TradeoffRow tradeoffRowFrom(const nlohmann::ordered_json& json);

}  // namespace diptych::tradeoff
