// SPDX-License-Identifier: MIT
// Results of an audit, and of relations, as text, JSON, CSV, plots, a page and a folder.
#pragma once

#include "compare/audit/audit.h"
#include "compare/audit/relate.h"
#include "compare/output/document.h"
#include "compare/plot/plot.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

inline constexpr const char* auditManifest = "audit.json";

// Parts shared by results of quantities and of relations.
// A page with `blocks` and the notes. `passes`: the verdict in its heading; empty: none. `files`: linked at
// the end.
std::string pageOf(const Audited& audited, const std::string& title, const std::string& about,
                   std::optional<bool> passes, std::vector<output::Block> blocks,
                   const std::vector<std::string>& files);
// `words`, after the colour of the series' path.
output::Text seriesText(const Series& series, const std::string& words);
// Adds scene, camera, Settings, device and notes.
void addAudited(nlohmann::ordered_json& json, const Audited& audited);
// Path and changed Settings.
nlohmann::ordered_json jsonOf(const Series& series);
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
// Inverse of toJson(); throws std::runtime_error on invalid JSON.
Step stepFromJson(const nlohmann::ordered_json& json);

// A row for each quantity, magnitude and series.
std::vector<const experiment::Row*> allRows(const Audit& audit);
// A line for each of them: quantity, magnitude, unit, path, settings, error, light, depth,
// flip, misplaced, nonfinite, failed.
std::string toCsv(const Audit& audit);

// Errors of every series over the magnitude, both axes logarithmic. Errors below 1e-8, where float32
// rounds, are at the bottom; infinite errors at the top; magnitude 0 at the left.
std::string auditPlot(const QuantityAudit& audit, PlotPlace place);

// One page without external resources, readable from file://. `files`: other files of the folder.
std::string auditHtml(const Audit& audit, const std::vector<std::string>& files);

// Writes the folder: index.html, audit.json, audit.csv, a plot for each quantity (NAME.svg), and the
// reduced scenes. Returns the JSON. Throws std::runtime_error naming -o if the folder contains something
// else.
std::string writeAudit(const Audit& audit, const std::filesystem::path& folder, bool force);

inline constexpr const char* relationsManifest = "relations.json";

struct RelationAudit : Audited {
    std::vector<RelationResult> relations;

    bool passes() const;
};

std::string_view verdictOf(const RelationResult& result);
std::string_view verdictOf(const SeriesResult& result);
// Likely cause; empty if nothing is broken.
std::string blameInWords(const RelationResult& result, const ReportDevice& device);
// "lit 3.1e-08 of 2e-07 at 12,30": the worst pixel; "the same" without a difference.
std::string worstInWords(const SeriesResult& result);

// "deferred, gbuffer full"; "reference, in double".
std::string seriesInWords(const SeriesResult& result);

// Terminal text of one relation: its name, verdict and worst pixel; all details if it is broken.
std::string inWords(const RelationResult& result, const ReportDevice& device);
// Number of relations that hold and that are broken.
std::string inWords(const RelationAudit& audit);

nlohmann::ordered_json toJson(const RelationAudit& audit);

// One page without external resources except images beside it. `files`: other files of the folder.
std::string relationsHtml(const RelationAudit& audit, const std::vector<std::string>& files);

// Writes the folder: index.html, relations.json, and NAME-SERIES-{given,changed,used}.png for each broken
// series. Returns the JSON. Throws std::runtime_error naming -o if the folder contains something else.
std::string writeRelations(const RelationAudit& audit, const std::filesystem::path& folder, bool force);

// Stem of a broken series' image files: "moved-deferred-full".
std::string pictureStem(const Relation& relation, const SeriesResult& result);

}  // namespace diptych::audit
