// SPDX-License-Identifier: MIT
#pragma once

#include "compare/files/checkpoint_folder.h"
#include "compare/tradeoff/measure.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace diptych::tradeoff {

// Checkpoint of the rows measured so far (CheckpointFolder). Each row is stored separately: images first,
// then JSON.
class SweepState {
public:
    // `key`: inputs of rows besides their Settings. Throws as CheckpointFolder does.
    SweepState(const std::filesystem::path& out, const nlohmann::ordered_json& key);

    bool isRenewed() const { return checkpoints_.isRenewed(); }  // rows of another key were removed
    // A stored row with `cameras` cameras, all with the same number of timing blocks, 1 to `blocks`.
    std::optional<TradeoffRow> find(const Settings& settings, std::size_t cameras, std::size_t blocks) const;
    void keep(MeasuredRow& measured);    // sets the row's file names
    void renew(const TradeoffRow& row);  // updates a stored row
    // Path of a stored row's file.
    std::filesystem::path operator/(const std::string& file) const { return checkpoints_ / file; }
    void remove();  // call when the sweep is done

    static std::filesystem::path folderOf(const std::filesystem::path& out);

private:
    CheckpointFolder checkpoints_;
};

}  // namespace diptych::tradeoff
