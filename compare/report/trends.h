// SPDX-License-Identifier: MIT
// What has changed since an earlier report.
#pragma once

#include "compare/report/texts.h"
#include "compare/verdict/comparison.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

enum class TrendKind { same, fails_now, mended, moved, fresh };
std::string_view nameOf(TrendKind kind);  // "same", "new failure", "mended", "moved", "new"

// A figure of a channel that is further from what it was than two runs of one path are from each other.
struct MovedFigure {
    std::string channel, figure;
    double from = 0, to = 0, noise = 0;  // 1e300: infinite
};

struct Trend {
    TrendKind kind = TrendKind::same;
    std::vector<MovedFigure> moved;  // whatever the kind
};

struct Trends {
    std::string report;  // as it was given
    std::string device;  // of the earlier report, where it is another; else empty
    std::vector<Trend> comparisons;
    std::vector<std::string> gone;  // scenes of comparisons that the earlier report alone has
};

// Of the comparisons of a report, whose rows these are. The largest error, mean, root mean square and
// percentiles of a channel change by no more than its errors do at any pixel, so that a figure has moved
// where it is off by more than the largest differences of two runs, of both paths and both reports, added up:
// by anything on a CPU, where runs are the same. FLIP, which is no such figure, and times are not judged.
// `earlier`: a report.json or the folder that it is in. Throws std::runtime_error naming it where it is none.
Trends trendsSince(const std::filesystem::path& earlier, const Report& report,
                   const std::vector<IndexRow>& rows);

nlohmann::ordered_json jsonOf(const Trends& trends, const Report& report);
// Lines for people: how many of each kind, and which scenes.
std::vector<std::string> trendLines(const Trends& trends, const Report& report);
std::string movedText(const MovedFigure& moved);  // "lit max 0.01 -> 0.02"

}  // namespace diptych
