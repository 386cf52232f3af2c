// SPDX-License-Identifier: MIT
// An audit in words, as JSON and as a table of values separated by commas.
#pragma once

#include "compare/audit/audit.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace diptych::audit {

// A number, or "infinite", which JSON has no number for.
nlohmann::ordered_json numberOf(double value);

// "0.03", "1e7".
std::string magnitudeInWords(double magnitude);

// How far a criterion holds: "1e-6 to 3.2e5", "up to 3.2e5", "all of it" that was tried, "not at all".
std::string rangeInWords(const ValidRange& range);
// The same of a prediction; `audit`: between which magnitudes it was tried. Empty where there is none.
std::string rangeInWords(const Predicted& predicted, const QuantityAudit& audit);

// Whether what was measured agrees with what was predicted, of a criterion (the two of errors) and a series;
// nothing where nothing is predicted.
std::optional<bool> agrees(const QuantityAudit& audit, std::size_t criterion, std::size_t series);

// One quantity for a terminal: its name, a line for each series, and what is to be said beside.
std::string inWords(const QuantityAudit& audit);
// What --require asked, one line each.
std::string inWords(const Requirement& requirement);

nlohmann::ordered_json toJson(const Audit& audit);
nlohmann::ordered_json toJson(const Step& step);
// The way back; throws nlohmann::json::exception where it is none.
Step stepFromJson(const nlohmann::ordered_json& json);

// A line for each magnitude and series: quantity, magnitude, unit, path, settings, error, light, depth, flip,
// misplaced, nonfinite, failed.
std::string toCsv(const Audit& audit);

}  // namespace diptych::audit
