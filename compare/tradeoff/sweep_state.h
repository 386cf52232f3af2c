// SPDX-License-Identifier: MIT
#pragma once

#include "compare/tradeoff/measure.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace diptych::tradeoff {

// The rows that a sweep has measured so far, in ".NAME.sweep" beside its output folder NAME. Each row is
// stored by itself, its JSON after its pictures, so that the next program can resume however this one ends.
// One program at a time may hold it. Throws std::runtime_error naming the folder.
class SweepState {
public:
    // `key`: everything that rows depend on besides their Settings. Rows of another key are removed.
    SweepState(const std::filesystem::path& out, const nlohmann::ordered_json& key);
    ~SweepState();
    SweepState(const SweepState&) = delete;
    SweepState& operator=(const SweepState&) = delete;

    bool isRenewed() const { return renewed_; }  // whether rows of another key were removed
    std::optional<TradeoffRow> find(const Settings& settings) const;
    void keep(MeasuredRow& measured);    // names the row's pictures
    void renew(const TradeoffRow& row);  // of one that is kept
    // The path of a file of a kept row.
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
