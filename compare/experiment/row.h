// SPDX-License-Identifier: MIT
// One row of an experiment: what is drawn, and what was measured.
#pragma once

#include "compare/experiment/measures.h"
#include "compare/output/document.h"
#include "shared/frame/frame.h"
#include "shared/frame/settings.h"
#include "shared/text/json_at.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::experiment {

// Numbers of a row; NaN: not measured.
class Measures {
public:
    Measures() { values_.fill(std::numeric_limits<double>::quiet_NaN()); }
    double operator[](Measure measure) const { return values_[static_cast<std::size_t>(measure)]; }
    double& operator[](Measure measure) { return values_[static_cast<std::size_t>(measure)]; }
    bool has(Measure measure) const { return !std::isnan((*this)[measure]); }

    // A group, from its first measure on.
    template <std::size_t count>
    void set(Measure first, const std::array<double, count>& values) {
        for (std::size_t i = 0; i < count; ++i) (*this)[first + i] = values[i];
    }
    void set(const FrameTime& time);
    void set(const FrameBytes& bytes);
    void set(const FrameCounters& counters);

private:
    std::array<double, measures.size()> values_;
};

struct Row {
    std::string scene{};   // as on the command line
    std::string varied{};  // what Measure::magnitude varies in the scene: "triangles"; empty: nothing
    std::string camera{};  // title
    Settings settings{};
    std::string renderer{}, renderer_file{};  // another renderer's; empty: drawn by settings.path

    std::string failed{};     // why it was skipped, or failed; empty: it was measured
    std::string judgement{};  // of the command, in a word: "raced"
    Measures measured{};
    std::vector<double> ms{};         // of each timed frame, in order
    std::vector<FrameTime> blocks{};  // frames that were timed together
    std::vector<PassTime> passes{};   // of profiled frames
    std::vector<std::string> warnings{};
    std::vector<Row> cameras{};  // if several were measured apart

    double operator[](Measure measure) const { return measured[measure]; }
    // The value of a count or bytes; 0 if it was not measured.
    std::uint64_t whole(Measure measure) const {
        return measured.has(measure) ? static_cast<std::uint64_t>(measured[measure]) : 0;
    }
};

// Sets the time from its blocks: the mean of their medians, so that blocks weigh equally; the least and
// greatest time; the number of frames.
void joinBlocks(Row& row);
// Sets what follows from the row's cameras (OverCameras); passes are means, in the first camera's order.
void joinCameras(Row& row);

// The row's value, and the least and greatest of a single camera.
struct CameraRange {
    double value = 0, low = 0, high = 0;
};
CameraRange cameraRangeOf(const Row& row, Measure measure);

// Numbers with all digits. A group that was not measured is null, and so is an infinite number.
nlohmann::ordered_json jsonOf(const Row& row);
// Reads the output of jsonOf(), for rows that a path drew: without renderer and judgement. Throws
// std::runtime_error naming the place of an error.
Row rowFrom(const JsonAt<nlohmann::ordered_json>& json);

// A value for a page: rounded by its unit; empty if it was not measured.
output::Cell cellOf(const Row& row, Measure measure);
// A column for cellOf(). `width`: in a terminal.
output::Column columnOf(Measure measure, std::size_t width = 0);

// Parts of tables for files, which have all digits.
std::string exactText(const Row& row, Measure measure);  // empty if it was not measured
std::string pathOf(const Row& row);                      // the path's name, or another renderer's
// Columns of the options that a sweep can vary, but the path; only those in which rows differ if `differing`.
// Empty where a row ignores the option.
void addOptions(output::Table& table, std::span<const Row* const> rows, bool differing);
// A column for each pass, its name between `before` and `after`.
void addPasses(output::Table& table, std::span<const Row* const> rows, std::string_view before,
               std::string_view after = "");

// Every row with the options in which rows differ and everything that any was measured for: rows.csv. Units
// are in the heads; numbers have all digits.
output::Table rowsTable(std::span<const Row* const> rows);
inline constexpr const char* rowsFile = "rows.csv";

template <class Rows>
std::vector<const Row*> pointersTo(const Rows& rows) {
    std::vector<const Row*> pointers;
    for (const auto& row : rows) pointers.push_back(&row);
    return pointers;
}

}  // namespace diptych::experiment
