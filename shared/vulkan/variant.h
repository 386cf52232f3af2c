// SPDX-License-Identifier: MIT
// The values of all features, which are the key of a shader's variant, and the sets of features that
// shared/contract/features.h states: who sets them, who reads them.
#pragma once

#include "shared/contract/features.h"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace diptych {

// A set of features.
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

// Who sets a feature.
enum class FeatureSource { item, frame, gbuffer, pass };

// One row of FEATURES.
struct FeatureRow {
    gpu::uint id;
    const char* name;
    FeatureSource source;
    bool switches;     // what a scene or a view may lack: 0 is a variant without it
    gpu::uint passes;  // PASS_*
};
namespace feature_table {
using namespace gpu;  // the last column names PASS_*
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

// The features that some of `passes` (a sum of PASS_*) reads.
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

// The values of all features, 0 where not set.
class Variant {
public:
    Variant& set(gpu::uint feature, gpu::uint value = 1) {
        values_.at(feature) = value;
        return *this;
    }
    gpu::uint get(gpu::uint feature) const { return values_.at(feature); }
    const std::array<gpu::uint, gpu::FEATURE_COUNT>& values() const { return values_; }

    // Sets the features of the mask to what they are in `from`.
    Variant& take(const Variant& from, FeatureMask mask) {
        for (gpu::uint i = 0; i < gpu::FEATURE_COUNT; ++i)
            if (mask.has(i)) values_[i] = from.values_[i];
        return *this;
    }
    // The features of the mask as they are, all others off.
    Variant only(FeatureMask mask) const { return Variant().take(*this, mask); }
    // Whether a feature of the mask is on.
    bool any(FeatureMask mask) const { return only(mask) != Variant(); }

    auto operator<=>(const Variant&) const = default;

private:
    std::array<gpu::uint, gpu::FEATURE_COUNT> values_{};
};

}  // namespace diptych
