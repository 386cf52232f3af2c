// SPDX-License-Identifier: MIT
// A Frame in JSON, as all our files hold it.
#pragma once

#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

namespace diptych {

// Everything but the pixels, as in the "frames" of a report.
nlohmann::ordered_json jsonOf(const Frame& frame);
nlohmann::ordered_json jsonOf(const FrameCamera& camera);
// Without "far" the camera has no far plane. Throws nlohmann::json::exception where a vector is missing or of
// another size.
FrameCamera cameraFromJson(const nlohmann::json& json);

// JSON has no infinity and no NaN: null stands for both.
nlohmann::ordered_json finiteOrNull(double value);

}  // namespace diptych
