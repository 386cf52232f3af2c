// SPDX-License-Identifier: MIT
#pragma once

#include "compare/tradeoff/measure.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace diptych::tradeoff {

// What a sweep has measured so far, in ".NAME.sweep" beside the folder NAME that it will leave: each row by
// itself, its record last, so that whatever ends the program the next one goes on from there. Held by one
// program at a time. Throws std::runtime_error naming the folder.
class SweepState {
public:
    // `key`: all that rows depend on beside their Settings. Rows of another key are removed.
    SweepState(const std::filesystem::path& out, const nlohmann::ordered_json& key);
    ~SweepState();
    SweepState(const SweepState&) = delete;
    SweepState& operator=(const SweepState&) = delete;

    bool isRenewed() const { return renewed_; }  // there were rows of another key
    std::optional<TradeoffRow> find(const Settings& settings) const;
    void keep(MeasuredRow& measured);    // names the row's pictures
    void renew(const TradeoffRow& row);  // of one that is kept
    // Of a kept row, under a name of the folder.
    std::filesystem::path operator/(const std::string& file) const { return folder_ / file; }
    void remove();  // all of it: the sweep is done

    static std::filesystem::path folderOf(const std::filesystem::path& out);

private:
    void clear();

    std::filesystem::path folder_;
    int lock_ = -1;
    bool renewed_ = false;
};

// 64 bits, FNV-1a (Fowler, Noll and Vo 1991), as 16 hexadecimal digits.
std::string fingerprint(std::string_view bytes);
// Of every bit of lit and material_id.
std::string fingerprint(const ReferenceFrames& references);

}  // namespace diptych::tradeoff
