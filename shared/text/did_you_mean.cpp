// SPDX-License-Identifier: MIT
#include "shared/text/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace diptych {
namespace {

std::string lower(std::string_view word) {
    std::string text(word);
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Optimal string alignment: rows are prefixes of `a`, columns prefixes of `b`.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> distance(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) distance[i][0] = i;
    for (std::size_t k = 0; k <= b.size(); ++k) distance[0][k] = k;
    for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t k = 1; k <= b.size(); ++k) {
            const std::size_t replaced = distance[i - 1][k - 1] + (a[i - 1] != b[k - 1]);
            distance[i][k] = std::min({distance[i - 1][k] + 1, distance[i][k - 1] + 1, replaced});
            if (i > 1 && k > 1 && a[i - 1] == b[k - 2] && a[i - 2] == b[k - 1])
                distance[i][k] = std::min(distance[i][k], distance[i - 2][k - 2] + 1);
        }
    return distance[a.size()][b.size()];
}

// Longer words are not typing errors, and would take time.
constexpr std::size_t longest = 64;

}  // namespace

std::string_view nearestWord(std::string_view word, std::span<const std::string> candidates) {
    if (word.size() > longest) return {};
    const std::string typed = lower(word);
    std::string_view nearest;
    std::size_t min = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = editDistance(typed, lower(candidate));
        if (distance >= min) continue;
        min = distance;
        nearest = candidate;
    }
    return nearest;
}

std::string didYouMean(std::string_view word, std::span<const std::string> candidates) {
    const std::string_view nearest = nearestWord(word, candidates);
    return nearest.empty() ? "" : fmt::format("; did you mean {}?", nearest);
}

}  // namespace diptych
