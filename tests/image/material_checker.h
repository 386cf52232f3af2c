// SPDX-License-Identifier: MIT
// Compares a Frame with the closed forms of the cells or with another Frame, at every pixel where all
// relevant textures show a single texel.
#pragma once

#include "shared/frame/frame.h"
#include "tests/image/material_cells.h"

#include <map>
#include <string>
#include <vector>

namespace diptych::tests {

// Result for a channel: number of checked values, number out of tolerance, and the worst error as a
// multiple of the tolerance.
struct CheckedValues {
    std::size_t values = 0, wrong = 0;
    double worst = 0;
    std::string worst_at;  // "cell NAME at X, Y: GOT, not EXPECTED"
};
using ChannelChecks = std::map<Channel, CheckedValues>;  // by channel

// Whether any value is out of tolerance.
bool anyWrong(const ChannelChecks& judgement);
std::string describe(const ChannelChecks& judgement);

// Material channels, depth and position against the closed form.
ChannelChecks againstClosedForm(const Frame& frame, const std::vector<Cell>& cells, const CellCamera& camera,
                                const CellDecode& decode);

// Every channel that both have, including light.
ChannelChecks againstReference(const Frame& frame, const Frame& reference, const std::vector<Cell>& cells,
                               const CellCamera& camera);

}  // namespace diptych::tests
