// SPDX-License-Identifier: MIT
// Statistical tables (a fault planted at every call) are run whole by a campaign alone:
// DIPTYCH_CAMPAIGN=1. Everywhere else a slice of each is run, chosen by
// DIPTYCH_SEED (1).
#pragma once

#include <cstdlib>
#include <string_view>

namespace diptych {

inline bool isCampaign() {
    const char* value = std::getenv("DIPTYCH_CAMPAIGN");
    return value != nullptr && std::string_view(value) != "" && std::string_view(value) != "0";
}

inline unsigned campaignSeed() {
    const char* value = std::getenv("DIPTYCH_SEED");
    return value == nullptr ? 1u : static_cast<unsigned>(std::strtoul(value, nullptr, 10));
}

// Which rows of a table are run: all of them, or the first and, from a seeded one on, one of `stride`.
class Rows {
public:
    explicit Rows(int stride)
        : stride_(isCampaign() ? 1 : stride),
          second_(static_cast<int>(campaignSeed() % static_cast<unsigned>(stride_))) {}

    // The row to run after `row`; rows count from 0.
    int after(int row) const { return row == 0 && second_ > 0 ? second_ : row + stride_; }
    // The most rows that the whole table may have where so many of the slice were counted.
    int atMost(int counted) const { return counted == 0 ? 0 : counted * stride_ + stride_ - 1; }

private:
    int stride_, second_;
};

}  // namespace diptych
