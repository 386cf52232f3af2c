// SPDX-License-Identifier: MIT
// Statistical tables, such as an injected fault at every call, run whole only with DIPTYCH_CAMPAIGN=1.
// Otherwise DIPTYCH_SEED (default 1) selects a subset of each table.
#pragma once

#include <cstdlib>
#include <string_view>
#include <vector>

namespace diptych {

inline bool isCampaign() {
    const char* value = std::getenv("DIPTYCH_CAMPAIGN");
    return value != nullptr && std::string_view(value) != "" && std::string_view(value) != "0";
}

inline unsigned campaignSeed() {
    const char* value = std::getenv("DIPTYCH_SEED");
    return value == nullptr ? 1u : static_cast<unsigned>(std::strtoul(value, nullptr, 10));
}

// The rows of a table to run. A campaign runs all; otherwise the first and every `stride`-th from a seeded
// row.
class Rows {
public:
    explicit Rows(int stride)
        : stride_(isCampaign() ? 1 : stride),
          second_(static_cast<int>(campaignSeed() % static_cast<unsigned>(stride_))) {}

    // The next row to run; rows count from 0.
    int after(int row) const { return row == 0 && second_ > 0 ? second_ : row + stride_; }
    // Upper bound on the size of the whole table if the subset had `counted` rows.
    int atMost(int counted) const { return counted == 0 ? 0 : counted * stride_ + stride_ - 1; }

private:
    int stride_, second_;
};

// The rows of a table to run, as a table.
template <class Row>
std::vector<Row> slice(const std::vector<Row>& table, int stride) {
    std::vector<Row> rows;
    const Rows which(stride);
    for (int row = 0; row < static_cast<int>(table.size()); row = which.after(row))
        rows.push_back(table[static_cast<std::size_t>(row)]);
    return rows;
}

}  // namespace diptych
