// SPDX-License-Identifier: MIT
// Runs the shipped moment filters on a filter that contains two depths.
#pragma once

#include "shared/contract/features.h"
#include "shared/contract/shadow.h"
#include "shared/frame/settings.h"
#include "tests/probe/probe.h"

#include <array>
#include <vector>

namespace diptych {

struct MomentFilter {
    float near, far, receiver;  // depths, 1 towards the light
    float fraction = 0.5f;      // fraction of the filter at depth `near`
    float exponent = 40, negative = 5, nearest = 0, bleed = 0, min_variance = 0, bias = 6e-5f;
};
struct MomentResult {
    float visibility;
    std::array<float, 4> moments;
};

// `shadows`: SHADOWS_*.
inline std::vector<MomentResult> seenThrough(gpu::uint shadows, const std::vector<MomentFilter>& filters) {
    std::vector<float> in;
    for (const MomentFilter& f : filters)
        in.insert(in.end(), {f.near, f.far, f.receiver, f.fraction, f.exponent, f.negative, f.nearest,
                             f.bleed, f.min_variance, f.bias});
    const std::vector<float> out = Probes().run("moments", in, 10, 5, {{gpu::FEATURE_shadows, shadows}});
    std::vector<MomentResult> results;
    for (std::size_t i = 0; i < out.size(); i += 5)
        results.push_back({out[i], {out[i + 1], out[i + 2], out[i + 3], out[i + 4]}});
    return results;
}

// The same, for given moments.
struct StoredMoments {
    std::array<float, 4> moments;
    MomentFilter filter;  // near, far and fraction are not read
};
inline std::vector<float> seenThrough(gpu::uint shadows, const std::vector<StoredMoments>& stored) {
    std::vector<float> in;
    for (const auto& [m, f] : stored)
        in.insert(in.end(), {m[0], m[1], m[2], m[3], f.receiver, f.exponent, f.negative, f.nearest, f.bleed,
                             f.min_variance, f.bias});
    return Probes().run("stored_moments", in, 11, 1, {{gpu::FEATURE_shadows, shadows}});
}

}  // namespace diptych
