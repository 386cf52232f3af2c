// SPDX-License-Identifier: MIT
// Vectorizable powers of floats: no calls, branches or tables.
#pragma once

#include <bit>
#include <cstdint>

// Functions with this attribute are compiled twice, for any x86-64 and for AVX2; the program selects one
// at start. Both give the same bits: AVX2 has no fused multiply-add, and their files are compiled with
// -ffp-contract=off. Disabled for sanitizers, which are not initialized at the time of the selection.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define DIPTYCH_WIDE_LANES __attribute__((target_clones("avx2", "default")))
#else
#define DIPTYCH_WIDE_LANES
#endif

namespace diptych::fast {

// log2 of a positive normal float; error at most 3e-7 absolute + 1.2e-7 relative. x = 2^e m with m in
// [sqrt(1/2), sqrt 2), and log2 m = (2 / ln 2) artanh((m - 1) / (m + 1)), as a series.
inline float log2(float x) {
    constexpr std::int32_t rootHalf = 0x3f3504f3;  // bits of sqrt(1/2)
    const std::int32_t above = std::bit_cast<std::int32_t>(x) - rootHalf;
    const auto exponent = static_cast<float>(above >> 23);
    const float m = std::bit_cast<float>((above & 0x7fffff) + rootHalf);
    const float t = (m - 1) / (m + 1), t2 = t * t;
    constexpr float scale = 2.885390082f;  // 2 / ln 2
    const float series = scale + t2 * (scale / 3 + t2 * (scale / 5 + t2 * (scale / 7)));
    return exponent + t * series;
}

// 2^x for x in [-126, 127]; relative error at most 2.5e-7. Rounds to the nearest integer by the shifter
// 1.5 2^23, then evaluates the exponential series to the sixth power of ln 2 times the remainder.
inline float exp2(float x) {
    constexpr float shifter = 12582912.0f;
    const float whole = (x + shifter) - shifter, f = (x - whole) * 0.693147181f;
    const float series =
        1 + f * (1 + f * (1.0f / 2 + f * (1.0f / 6 + f * (1.0f / 24 + f * (1.0f / 120 + f * (1.0f / 720))))));
    return series * std::bit_cast<float>((static_cast<std::int32_t>(whole) + 127) << 23);
}

// x^p for x >= 0 and p in [0, 3], if the result is a normal float; exactly 0 if x is below the least
// normal float. Relative error at most 3e-7 + 1.2e-7 p |log2 x|: below 1e-6 for x in [1e-3, 1].
inline float pow(float x, float p) {
    constexpr float min = 0x1p-126f;
    const float exponent = p * fast::log2(x < min ? min : x);
    const float power = fast::exp2(exponent < -126.0f ? -126.0f : exponent);
    return x < min ? 0.0f : power;
}

}  // namespace diptych::fast
