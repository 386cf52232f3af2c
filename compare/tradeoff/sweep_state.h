// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/kept_folder.h"
#include "compare/tradeoff/measure.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace diptych::tradeoff {

// The rows that a sweep has measured so far (KeptFolder). Each row is stored by itself, its JSON after its
// pictures.
class SweepState {
public:
    // `key`: everything that rows depend on besides their Settings. Throws as KeptFolder does.
    SweepState(const std::filesystem::path& out, const nlohmann::ordered_json& key);

    bool isRenewed() const { return kept_.isRenewed(); }  // whether rows of another key were removed
    // A row from so many cameras, each visited equally often, `visits` times at most.
    std::optional<TradeoffRow> find(const Settings& settings, std::size_t cameras, std::size_t visits) const;
    void keep(MeasuredRow& measured);    // names the row's pictures
    void renew(const TradeoffRow& row);  // of one that is kept
    // The path of a file of a kept row.
    std::filesystem::path operator/(const std::string& file) const { return kept_ / file; }
    void remove();  // all of it: the sweep is done

    static std::filesystem::path folderOf(const std::filesystem::path& out);

private:
    KeptFolder kept_;
};

// 64 bits, FNV-1a (Fowler, Noll and Vo 1991), as 16 hexadecimal digits.
std::string fingerprint(std::string_view bytes);
// Of every bit of lit and material_id.
std::string fingerprint(const ReferenceFrames& references);

}  // namespace diptych::tradeoff
