// SPDX-License-Identifier: MIT
// Measurements of one row of a sweep: one Settings.
#pragma once

#include "compare/experiment/errors.h"
#include "compare/tradeoff/sample_shares.h"
#include "compare/tradeoff/shadow_errors.h"
#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych::tradeoff {

using experiment::errorFigures;
using experiment::Errors;
using experiment::NamedMetric;

struct CameraRow {
    std::string camera;             // title: "default view"
    std::vector<FrameTime> blocks;  // one per timing block
    std::vector<PassTime> passes;
    FrameBytes bytes;
    Errors errors{};
    std::uint64_t pixels = 0;  // number of compared pixels
    std::optional<ShadowErrors> shadow{};
    std::optional<SampleShares> samples{};
};

struct TradeoffRow {
    Settings settings;  // camera: the first one
    std::vector<CameraRow> cameras;
    Errors errors{};           // over all cameras' pixels
    double drawing_ms = 0;     // wall-clock time of rendering and timing
    std::string picture{};     // file name
    std::string errors_map{};  // file name of the FLIP image
    std::vector<std::string> warnings{};
    // External renderer: name and file. Its time is that of its whole command, so fronts and plots skip
    // such rows.
    std::string renderer{}, renderer_file{};
};

// Over all timing blocks: the mean of their medians, so that blocks weigh equally; the least and greatest
// time; the total number of frames.
FrameTime timeOf(const CameraRow& camera);

struct Spread {
    double value = 0, low = 0, high = 0;
};
// Means over the cameras of median, least and greatest time, ms.
Spread timeOf(const TradeoffRow& row);
// The error over all cameras' pixels, and the least and greatest of a single camera.
Spread errorOf(const TradeoffRow& row, std::size_t figure);
// Means over the cameras, ms; in the first camera's order.
std::vector<PassTime> passesOf(const TradeoffRow& row);
// The bytes of the camera that needs most, and their sum of images and buffers.
FrameBytes bytesOf(const TradeoffRow& row);
std::uint64_t memoryOf(const TradeoffRow& row);
// Means over the cameras; empty if a camera has no value.
std::optional<ShadowErrors> shadowOf(const TradeoffRow& row);
std::optional<SampleShares> samplesOf(const TradeoffRow& row);

// Numbers with all digits; an infinite error is null.
nlohmann::ordered_json jsonOf(const TradeoffRow& row);
// Reads the output of jsonOf(). Throws std::runtime_error naming the place of an error.
TradeoffRow tradeoffRowFrom(const nlohmann::ordered_json& json);

}  // namespace diptych::tradeoff
