// SPDX-License-Identifier: MIT
// Relations in words, as JSON, as a page and as a folder.
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

// "holds", "broken", "does not apply".
std::string_view verdictOf(const RelationResult& result);
std::string_view verdictOf(const SeriesResult& result);
// Whose fault it is; empty where nothing is broken.
std::string blameInWords(const RelationResult& result, const ReportDevice& device);
// "lit 3.1e-08 of 2e-07 at 12,30": the worst pixel; "the same" where there is no difference.
std::string worstInWords(const SeriesResult& result);

// "deferred, gbuffer full"; "reference, in double".
std::string seriesInWords(const SeriesResult& result);

// One relation for a terminal: its name, its verdict and the worst pixel; a broken one with all that is
// known.
std::string inWords(const RelationResult& result, const ReportDevice& device);
// How many hold, and how many are broken.
std::string inWords(const RelationAudit& audit);

nlohmann::ordered_json toJson(const RelationAudit& audit);

// One page without external resources but the pictures beside it. `files`: others of the folder.
std::string relationsHtml(const RelationAudit& audit, const std::vector<std::string>& files);

// Writes the folder: index.html, relations.json, and of each broken series NAME-SERIES-{given,changed,
// used}.png. Returns the JSON. Throws std::runtime_error naming -o where something else is there.
std::string writeRelations(const RelationAudit& audit, const std::filesystem::path& folder, bool force);

// "moved-deferred-full": what the pictures of a broken series are named by.
std::string pictureStem(const Relation& relation, const SeriesResult& result);

}  // namespace diptych::audit
