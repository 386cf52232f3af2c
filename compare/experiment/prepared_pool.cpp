// SPDX-License-Identifier: MIT
#include "compare/experiment/prepared_pool.h"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <utility>

namespace diptych::experiment {

namespace {

// Bytes of freed host memory that are kept for the next pipelines (compare/render/MEASURED.md).
constexpr std::size_t maxFreed = std::size_t{128} << 20;
constexpr std::array first{std::size_t{0}};  // the only frame of a PreparedFrames

}  // namespace

PreparedFrames& PreparedPool::frame(const Settings& settings) {
    const auto found = std::ranges::find(latest_, settings, &Prepared::settings);
    if (found != latest_.end()) {
        latest_.splice(latest_.end(), latest_, found);
        return latest_.back().frames;
    }
    // Expects it to be as large as the one before.
    keep(maxBytes - std::min(maxBytes, latest_.empty() ? 0 : latest_.back().bytes));
    PreparedFrames frames = renderer_.prepare(std::span(&settings, 1));
    const FrameBytes bytes = frames.described(0).bytes;
    latest_.push_back({settings, std::move(frames), bytes.images + bytes.buffers});
    keep(maxBytes);
    latest_.back().frames.draw(0);
    std::erase_if(shots_, [&](const Shot& shot) { return shot.settings == settings; });
    shots_.push_back({settings, latest_.back().frames.lit(0), bytes});
    if (shots_.size() > maxShots) shots_.pop_front();
    latest_.back().frames.warmUp(first);
    if (mallinfo2().fordblks > maxFreed) malloc_trim(0);
    return latest_.back().frames;
}

const Shot& PreparedPool::shot(const Settings& settings) {
    const auto found = std::ranges::find(shots_, settings, &Shot::settings);
    if (found != shots_.end()) return *found;
    frame(settings);
    return *std::ranges::find(shots_, settings, &Shot::settings);
}

std::vector<double> PreparedPool::time(std::span<const Settings> frames, std::span<const std::size_t> order) {
    std::vector<double> ms;
    if (!order.empty()) frame(frames[order.front()]).warmUp(first);
    for (const std::size_t i : order) ms.push_back(frame(frames[i]).draw(0));
    return ms;
}

void PreparedPool::keep(std::uint64_t max) {
    std::uint64_t kept = 0;
    for (const Prepared& each : latest_) kept += each.bytes;
    for (; latest_.size() > 1 && kept > max; latest_.pop_front()) kept -= latest_.front().bytes;
}

}  // namespace diptych::experiment
