// SPDX-License-Identifier: MIT
// Changes since an earlier report.
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

// A channel's metric that changed by more than the noise between two runs.
struct MovedMetric {
    std::string channel, metric;
    double from = 0, to = 0, noise = 0;  // 1e300: infinite
};

struct Trend {
    TrendKind kind = TrendKind::same;
    std::vector<MovedMetric> moved;  // for every kind
};

struct Trends {
    std::string report;  // as given by the user
    std::string device;  // of the earlier report if it differs; else empty
    std::vector<Trend> comparisons;
    std::vector<std::string> gone;  // scenes whose comparisons only the earlier report has
};

// Trends of a report's comparisons; `rows` are its rows. Maximum, mean, RMSE and percentiles change by no
// more than the error of any pixel. So a metric has moved if it changed by more than the noise: the
// largest differences of two runs, summed over both paths and both reports. On a CPU runs are identical,
// and any change counts. FLIP, which has no such bound, and times are not evaluated. `earlier`: a report.json
// or its folder. Throws std::runtime_error naming it if it is not a report.
Trends trendsSince(const std::filesystem::path& earlier, const Report& report,
                   const std::vector<IndexRow>& rows);

nlohmann::ordered_json jsonOf(const Trends& trends, const Report& report);
// Lines for people: the count of each kind, and its scenes.
std::vector<std::string> trendLines(const Trends& trends, const Report& report);
std::string movedText(const MovedMetric& moved);  // "lit max 0.01 -> 0.02"

}  // namespace diptych
