// SPDX-License-Identifier: MIT
// Texts about each comparison. A report of one scene makes them from its Frames at the end. With many
// scenes they are stored in parts (parts.h), and the Frames are freed.
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
    // `used`: fraction of the limit. Infinity is 1e300, for JSON and sorting; flip < 0: not measured.
    double used = 0, max = 0, mean = 0, rmse = 0, p99 = 0, p999 = 0, flip = -1;
    double noise = 0;  // the largest difference of two runs, summed over both paths
};

// A comparison in that table.
struct IndexRow {
    // The channel that uses the largest fraction of its limit; nullptr: none.
    const DebugMode* worst = nullptr;
    double used = 0;                   // that fraction
    double left_ms = 0, right_ms = 0;  // frame times
    bool left_timed = false, right_timed = false;
    std::string cause;                   // the main cause of a difference of lit, if it was analysed
    std::string device;                  // the renderer's device
    std::string key;                     // rowKey()
    std::vector<IndexChannel> channels;  // the compared channels
};
nlohmann::ordered_json jsonOf(const IndexRow& row);
// Read from a file. Throw std::runtime_error naming the position.
IndexRow indexRowFrom(const JsonAt<nlohmann::json>& json);
const DebugMode& debugModeFrom(const JsonAt<nlohmann::json>& index);

// A test suite of junit.xml.
struct JunitSuite {
    std::string xml;
    std::size_t tests = 0, failures = 0;
    double seconds = 0;

    void operator+=(const JunitSuite& other) {
        xml += other.xml;
        tests += other.tests;
        failures += other.failures;
        seconds += other.seconds;
    }
};

// A device and the time spent there on comparing and writing. Times of several devices are not added.
struct DrawnOn {
    ReportDevice device;
    std::size_t comparisons = 0;
    double compare_ms = 0, encode_ms = 0;
};

struct ReportTexts {
    std::shared_ptr<const Trends> since;  // nullptr: none
    std::vector<DrawnOn> devices;
    std::vector<IndexRow> rows;                       // per comparison
    std::vector<std::string> closer_boxes;            // HTML, per Report::closer_paths
    std::function<std::string(std::size_t)> section;  // of a comparison, in the page
};

// Identifies a comparison across reports by scene, pair and camera.
std::string rowKey(const std::string& scene, const std::string& baseline, const std::string& test,
                   const std::string& camera_json);

IndexRow indexRowOf(const Report& report, const Comparison& comparison);

// The report's one device, with the times of comparing and writing.
DrawnOn drawnOn(const Report& report, const ReportLayout* layout);

}  // namespace diptych
