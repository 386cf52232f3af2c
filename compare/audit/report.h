// SPDX-License-Identifier: MIT
// Results of an audit, and of its relations, as blocks for a terminal and a page, as JSON, and as a folder.
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
inline constexpr const char* relationsManifest = "relations.json";

// Parts shared by results of quantities and of relations.
// A page with `blocks` and the notes. `passes`: the verdict in its heading; empty: none. `files`: linked at
// the end.
std::string pageOf(const Audited& audited, const std::string& title, const std::string& about,
                   std::optional<bool> passes, std::vector<output::Block> blocks,
                   const std::vector<std::string>& files);
// `text`, after the colour of the series' path.
output::Text seriesText(const Series& series, const std::string& text);

// "0.03", "1e7"; of a quantity with its unit: "1e7 m".
std::string magnitudeText(double magnitude);
std::string magnitudeText(double magnitude, const Quantity& quantity);
// Range in which a criterion is met: "1e-6 to 3.2e5", "up to 3.2e5", "whole range", "nowhere".
std::string rangeText(const ValidRange& range);
// The same for a prediction; `audit` gives the range of magnitudes tried. Empty without a prediction.
std::string rangeText(const Predicted& predicted, const QuantityAudit& audit);

// One quantity: for a terminal its table of valid ranges, on a page its plot; remarks and failures.
std::vector<output::Block> blocksOf(const QuantityAudit& audit);
// A paragraph for each --require.
std::vector<output::Block> closingOf(const Audit& audit);
// audit.csv: a row for each quantity, magnitude and series.
output::Table stepTable(const Audit& audit);
// Errors of every series over the magnitude, both axes logarithmic. Errors below 1e-8, where float32
// rounds, are at the bottom; infinite errors at the top; magnitude 0 at the left.
std::string auditPlot(const QuantityAudit& audit, PlotTarget target);

nlohmann::ordered_json toJson(const Audit& audit);
nlohmann::ordered_json toJson(const Step& step);
// Inverse of toJson(); throws std::runtime_error on invalid JSON.
Step stepFromJson(const nlohmann::ordered_json& json);

// Writes the folder: index.html, audit.json, audit.csv, rows.csv, a plot for each quantity (NAME.svg), and
// the reduced scenes. Returns the JSON. Throws std::runtime_error naming -o if the folder contains something
// else.
std::string writeAudit(const Audit& audit, const std::filesystem::path& folder, bool force);

struct RelationAudit : Audited {
    std::vector<RelationResult> relations;

    bool passes() const;
};

// "holds", "broken", "does not apply".
std::string_view verdictOf(const RelationResult& result);
std::string_view verdictOf(const SeriesResult& result);
// Likely cause; empty if nothing is broken.
std::string blameText(const RelationResult& result, const ReportDevice& device);

// One relation: its name, verdict and worst pixel; if it is broken, every series with images.
std::vector<output::Block> blocksOf(const RelationResult& result, const ReportDevice& device);
// Numbers of relations that hold, are broken and do not apply.
std::vector<output::Block> closingOf(const RelationAudit& audit);

nlohmann::ordered_json toJson(const RelationAudit& audit);

// Writes the folder: index.html, relations.json, and NAME-SERIES-{given,changed,used}.png for each broken
// series. Returns the JSON. Throws std::runtime_error naming -o if the folder contains something else.
std::string writeRelations(const RelationAudit& audit, const std::filesystem::path& folder, bool force);

// An image file of a broken series; `shown`: given, changed or used: "moved-deferred-full-given.png".
std::string imageName(const Relation& relation, const Series& series, std::string_view shown);

}  // namespace diptych::audit
