// SPDX-License-Identifier: MIT
// A pixel breakdown as text and JSON.
#pragma once

#include "compare/explain/pixel_breakdown.h"

#include <nlohmann/json.hpp>

#include <string>

namespace diptych {

std::string inWords(const PixelBreakdown& breakdown);
nlohmann::ordered_json toJson(const PixelBreakdown& breakdown);

// "the first step that differs by more than rounding: roughness (0.301 against 0.298, 0.003 in its metric,
// absolute, tolerance 0.002: ...)", or that there is none. One line without a newline.
std::string firstDifference(const PixelBreakdown& breakdown);

}  // namespace diptych
