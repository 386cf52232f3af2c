// SPDX-License-Identifier: MIT
// Values of all features, which select a shader variant, and feature sets of shared/contract/features.h:
// who sets them and who reads them.
#pragma once

#include "shared/contract/features.h"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace diptych {

class FeatureMask {
public:
    constexpr FeatureMask() = default;
    constexpr bool has(gpu::uint feature) const { return (words_[feature / 64] >> feature % 64 & 1) != 0; }
    constexpr FeatureMask with(gpu::uint feature) const {
        FeatureMask mask = *this;
        mask.words_[feature / 64] |= std::uint64_t{1} << feature % 64;
        return mask;
    }
    constexpr FeatureMask operator&(const FeatureMask& other) const {
        FeatureMask mask;
        for (std::size_t i = 0; i < words_.size(); ++i) mask.words_[i] = words_[i] & other.words_[i];
        return mask;
    }
    constexpr FeatureMask operator|(const FeatureMask& other) const {
        FeatureMask mask;
        for (std::size_t i = 0; i < words_.size(); ++i) mask.words_[i] = words_[i] | other.words_[i];
        return mask;
    }
    constexpr bool operator==(const FeatureMask&) const = default;

private:
    std::array<std::uint64_t, (gpu::FEATURE_COUNT + 63) / 64> words_{};
};

enum class FeatureSource { item, frame, gbuffer, pass };

struct FeatureRow {
    gpu::uint id;
    const char* name;
    FeatureSource source;
    bool switches;     // 0 selects a variant without the feature
    gpu::uint passes;  // PASS_*
};
namespace feature_table {
using namespace gpu;  // the last column uses PASS_*
struct SetBy {        // the column "set by"
    FeatureSource from;
    bool switches;
};
inline constexpr SetBy item{FeatureSource::item, true}, frame{FeatureSource::frame, true},
    amount{FeatureSource::frame, false}, gbuffer{FeatureSource::gbuffer, false},
    pass{FeatureSource::pass, false};
inline constexpr FeatureRow rows[] = {
#define DIPTYCH_FEATURE_ROW(id, name, source, passes) \
    FeatureRow{id, #name, source.from, source.switches, passes},
    FEATURES(DIPTYCH_FEATURE_ROW)
#undef DIPTYCH_FEATURE_ROW
};
}  // namespace feature_table
inline constexpr auto& featureRows = feature_table::rows;

// Features that at least one of `passes` (a sum of PASS_*) reads.
constexpr FeatureMask featuresReadBy(gpu::uint passes) {
    FeatureMask mask;
    for (const FeatureRow& row : featureRows)
        if ((row.passes & passes) != 0) mask = mask.with(row.id);
    return mask;
}

constexpr FeatureMask featuresSetBy(FeatureSource source) {
    FeatureMask mask;
    for (const FeatureRow& row : featureRows)
        if (row.source == source) mask = mask.with(row.id);
    return mask;
}

// Values of all features, 0 by default.
class Variant {
public:
    Variant& set(gpu::uint feature, gpu::uint value = 1) {
        values_.at(feature) = value;
        return *this;
    }
    gpu::uint get(gpu::uint feature) const { return values_.at(feature); }
    const std::array<gpu::uint, gpu::FEATURE_COUNT>& values() const { return values_; }

    // Copies the features of the mask from `from`.
    Variant& take(const Variant& from, FeatureMask mask) {
        for (gpu::uint i = 0; i < gpu::FEATURE_COUNT; ++i)
            if (mask.has(i)) values_[i] = from.values_[i];
        return *this;
    }
    // A copy with the features of the mask; all others are 0.
    Variant only(FeatureMask mask) const { return Variant().take(*this, mask); }
    // Whether a feature of the mask is not 0.
    bool any(FeatureMask mask) const { return only(mask) != Variant(); }

    auto operator<=>(const Variant&) const = default;

private:
    std::array<gpu::uint, gpu::FEATURE_COUNT> values_{};
};

}  // namespace diptych
