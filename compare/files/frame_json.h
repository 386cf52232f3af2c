// SPDX-License-Identifier: MIT
// A Frame as JSON, in all our files.
#pragma once

#include "shared/frame/frame.h"
#include "shared/text/json_at.h"

#include <nlohmann/json.hpp>

namespace diptych {

// Everything except pixels, as in "frames" of a report.
nlohmann::ordered_json jsonOf(const Frame& frame);
nlohmann::ordered_json jsonOf(const FrameCamera& camera);
// A missing "far" means no far plane. Throws std::runtime_error naming the place of a missing or short
// vector.
FrameCamera cameraFrom(const JsonAt<nlohmann::json>& json);

// Null for infinity and NaN, which JSON lacks.
nlohmann::ordered_json finiteOrNull(double value);

}  // namespace diptych
