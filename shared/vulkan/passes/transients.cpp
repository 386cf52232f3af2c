// SPDX-License-Identifier: MIT
#include "shared/vulkan/passes/transients.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace diptych {

std::vector<SharedBlock> shareMemory(std::span<const Transient> transients) {
    std::vector<std::size_t> order(transients.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>(),
                             [&](std::size_t i) { return transients[i].needs.size; });
    std::vector<SharedBlock> blocks;
    for (const std::size_t i : order) {
        const Transient& image = transients[i];
        const auto apart = [&](std::size_t other) {
            return transients[other].last < image.first || image.last < transients[other].first;
        };
        const auto block = std::ranges::find_if(blocks, [&](const SharedBlock& b) {
            return (b.needs.memoryTypeBits & image.needs.memoryTypeBits) != 0 &&
                   std::ranges::all_of(b.members, apart);
        });
        if (block == blocks.end()) {
            blocks.push_back({image.needs, {i}});
            continue;
        }
        block->needs.memoryTypeBits &= image.needs.memoryTypeBits;
        block->needs.alignment = std::max(block->needs.alignment, image.needs.alignment);
        block->members.push_back(i);
    }
    for (SharedBlock& block : blocks)
        std::ranges::sort(block.members, {}, [&](std::size_t i) { return transients[i].first; });
    return blocks;
}

}  // namespace diptych
