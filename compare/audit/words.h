// SPDX-License-Identifier: MIT
// Results of an audit as text, JSON and CSV.
#pragma once

#include "compare/audit/audit.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace diptych::audit {

// A number, or the string "infinite", which JSON numbers cannot express.
nlohmann::ordered_json numberOf(double value);

// "0.03", "1e7".
std::string magnitudeInWords(double magnitude);

// Range in which a criterion is met: "1e-6 to 3.2e5", "up to 3.2e5", "whole range", "not at all".
std::string rangeInWords(const ValidRange& range);
// The same for a prediction; `audit` gives the range of magnitudes tried. Empty without a prediction.
std::string rangeInWords(const Predicted& predicted, const QuantityAudit& audit);

// Whether measurement and prediction agree for a criterion (only the two error criteria) and a series;
// empty without a prediction.
std::optional<bool> agrees(const QuantityAudit& audit, std::size_t criterion, std::size_t series);

// Terminal text of one quantity: its name, a line for each series, and remarks.
std::string inWords(const QuantityAudit& audit);
// One line for each --require.
std::string inWords(const Requirement& requirement);

nlohmann::ordered_json toJson(const Audit& audit);
nlohmann::ordered_json toJson(const Step& step);
// Inverse of toJson(); throws nlohmann::json::exception on invalid JSON.
Step stepFromJson(const nlohmann::ordered_json& json);

// A line for each magnitude and series: quantity, magnitude, unit, path, settings, error, light, depth,
// flip, misplaced, nonfinite, failed.
std::string toCsv(const Audit& audit);

}  // namespace diptych::audit
