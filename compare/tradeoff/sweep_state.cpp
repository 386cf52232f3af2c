// SPDX-License-Identifier: MIT
#include "compare/tradeoff/sweep_state.h"

#include "compare/experiment/row_checkpoint.h"
#include "compare/files/output.h"

#include <algorithm>

namespace diptych::tradeoff {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using experiment::fingerprint;

constexpr const char* folderName = "sweep";

std::string nameOf(const Settings& settings) {
    return fingerprint(toJson(settings, -1));
}
// External renderers have the same Settings: add the name.
std::string nameOf(const TradeoffRow& row) {
    return row.renderer.empty() ? nameOf(row.settings) : fingerprint(toJson(row.settings, -1) + row.renderer);
}
std::string imageOf(const TradeoffRow& row) {
    return nameOf(row) + ".png";
}
std::string errorsOf(const TradeoffRow& row) {
    return nameOf(row) + ".flip.png";
}

}  // namespace

fs::path SweepState::folderOf(const fs::path& out) {
    return besideOutput(out, folderName);
}

SweepState::SweepState(const fs::path& out, const Json& key) : checkpoints_(out, folderName, key) {}

std::optional<TradeoffRow> SweepState::find(const Settings& settings, std::size_t cameras,
                                            std::size_t blocks) const {
    return experiment::findCheckpoint(checkpoints_, nameOf(settings), [&](const Json& json) {
        TradeoffRow row = tradeoffRowFrom(json);
        const auto isVisited = [&](const experiment::Row& camera) {
            const std::size_t times = camera.blocks.size();
            return times > 0 && times <= blocks && times == row.cameras.front().blocks.size();
        };
        const bool whole = row.settings == settings && row.cameras.size() == cameras &&
                           std::ranges::all_of(row.cameras, isVisited) && row.image == imageOf(row) &&
                           row.errors_map == errorsOf(row) && fs::exists(checkpoints_ / row.image) &&
                           fs::exists(checkpoints_ / row.errors_map);
        return whole ? std::optional(std::move(row)) : std::nullopt;
    });
}

void SweepState::keep(MeasuredRow& measured) {
    TradeoffRow& row = measured.row;
    row.image = imageOf(row);
    row.errors_map = errorsOf(row);
    writePng(checkpoints_ / row.image, measured.image);
    writePng(checkpoints_ / row.errors_map, measured.errors);
    renew(row);
}

void SweepState::renew(const TradeoffRow& row) {
    checkpoints_.keep(nameOf(row), jsonOf(row));
}

void SweepState::remove() {
    checkpoints_.remove();
}

}  // namespace diptych::tradeoff
