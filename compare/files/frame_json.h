// SPDX-License-Identifier: MIT
// What every JSON file of ours says of a Frame.
#pragma once

#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

namespace diptych {

// All but its pixels, as a report's "frames" holds it.
nlohmann::ordered_json jsonOf(const Frame& frame);
nlohmann::ordered_json jsonOf(const FrameCamera& camera);
// Without its "far" there is no far plane. Throws nlohmann::json::exception where a vector is missing or of
// another size.
FrameCamera cameraFromJson(const nlohmann::json& json);

// JSON has no infinity and no NaN: null stands for both.
nlohmann::ordered_json finiteOrNull(double value);

}  // namespace diptych
