// SPDX-License-Identifier: MIT
// What a report says of each of its comparisons, ready to be put together. A report of one scene makes it of
// its Frames at the end; of many scenes each one's is kept in a part (parts.h), and the Frames are let go.
#pragma once

#include "compare/report/layout.h"
#include "compare/verdict/comparison.h"
#include "shared/text/json_at.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace diptych {

// A channel in the table of comparisons.
struct IndexChannel {
    std::string name, verdict;  // as nameOf(Verdict)
    // Of the limit, a share; what is infinite is 1e300, as JSON and sorting have it; FLIP below 0: none.
    double used = 0, max = 0, mean = 0, rmse = 0, p99 = 0, p999 = 0, flip = -1;
    double noise = 0;  // the largest difference of two runs, of both paths together
};

// A comparison in that table.
struct IndexRow {
    const DebugMode* worst = nullptr;  // the channel that uses most of its limit; nullptr: there is none
    double used = 0;                   // by it
    double left_ms = 0, right_ms = 0;  // frames
    bool left_timed = false, right_timed = false;
    std::string cause;   // that explains most of a difference of lit, where that was looked for
    std::string device;  // that drew it
    std::string key;     // rowKey()
    std::vector<IndexChannel> channels;  // that were compared
};
nlohmann::ordered_json jsonOf(const IndexRow& row);
// Of a file's. Throw std::runtime_error naming the place.
IndexRow indexRowFrom(const JsonAt<nlohmann::json>& json);
const DebugMode& debugModeFrom(const JsonAt<nlohmann::json>& number);

// Of junit.xml.
struct JunitSuite {
    std::string xml;
    std::size_t tests = 0, failures = 0;
    double seconds = 0;
};

// A device and the time that was spent there on comparing and on writing. Times of several are never added
// up.
struct DrawnOn {
    ReportDevice device;
    std::size_t comparisons = 0;
    double compare_ms = 0, encode_ms = 0;
};

struct ReportTexts {
    std::shared_ptr<const Trends> since;  // nullptr: none
    std::vector<DrawnOn> devices;
    std::vector<IndexRow> rows;                       // per comparison
    std::vector<std::string> closer_boxes;            // of the page, per Report::closer_paths
    std::function<std::string(std::size_t)> section;  // of a comparison, in the page
};

// What a comparison is called by from report to report: scene, pair and camera.
std::string rowKey(const std::string& scene, const std::string& baseline, const std::string& test,
                   const std::string& camera_json);

IndexRow indexRowOf(const Report& report, const Comparison& comparison);

// The one device of a report, as it was drawn.
DrawnOn drawnOn(const Report& report, const ReportLayout* layout);

}  // namespace diptych
