// SPDX-License-Identifier: MIT
// Results of relations as text, JSON, an HTML page and a folder.
#pragma once

#include "compare/audit/relate.h"
#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace diptych::audit {

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
