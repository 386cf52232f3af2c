// SPDX-License-Identifier: MIT
// A Frame in JSON, as all our files hold it.
#pragma once

#include "shared/frame/frame.h"
#include "shared/text/json_at.h"

#include <nlohmann/json.hpp>

namespace diptych {

// Everything but the pixels, as in the "frames" of a report.
nlohmann::ordered_json jsonOf(const Frame& frame);
nlohmann::ordered_json jsonOf(const FrameCamera& camera);
// Without "far" the camera has no far plane. Throws std::runtime_error naming the place where a vector is
// missing or too short.
FrameCamera cameraFrom(const JsonAt<nlohmann::json>& json);

// JSON has no infinity and no NaN: null stands for both.
nlohmann::ordered_json finiteOrNull(double value);

}  // namespace diptych
