// SPDX-License-Identifier: MIT
// Texts and checks that several rows of setting_rows.h share.
#pragma once

#include "shared/frame/settings.h"

#include <cmath>
#include <string_view>

namespace diptych::row {

inline constexpr std::string_view needs_evsm = "has no effect without --shadows evsm or evsm4";
inline constexpr std::string_view needs_evsm4 = "has no effect without --shadows evsm4";
inline constexpr std::string_view needs_clipmap = "has no effect without --shadows clipmap";
inline constexpr std::string_view exponents =
    "must be 0 to 44.36, or 0 to 5.54 with 16-bit moments; larger squares exceed the format";
inline constexpr std::string_view needs_shadows = "has no effect without --shadows";
inline constexpr std::string_view needs_cascades =
    "has no effect without --shadows pcf, pcss, evsm, evsm4 or msm4";
inline constexpr std::string_view needs_reference =
    "has no effect without a reference (--path reference, compare: --baseline reference)";
inline constexpr std::string_view every_light = "the reference evaluates every light";
inline constexpr std::string_view traces_shadows = "the reference traces the shadows of every light";
inline constexpr std::string_view only_reference = "only the reference takes several samples of a surface";

inline constexpr int largest_side = 16384;  // at most maxImageDimension2D of current Vulkan 1.3 devices
inline constexpr int max_pages = 16384;
inline constexpr int max_samples = 65536;  // more would take a day for a small image

inline constexpr std::string_view needs_env =
    "has no effect without --env (--env scene uses the environment in the scene's file)";
inline constexpr std::string_view needs_haze = "has no effect without --haze on";
inline constexpr std::string_view scattering = "components must be 0 to 1e6 1/m";
inline constexpr std::string_view scale_height = "must be 0.01 to 1e9 m";
inline bool isHazy(const Settings& s) {
    return s.haze;
}
constexpr bool isScattering(const Rgb& c) {
    const auto fits = [](float x) { return x >= 0 && x <= 1e6f; };
    return fits(c.r) && fits(c.g) && fits(c.b);
}
constexpr bool isScaleHeight(float metres) {
    return metres >= 0.01f && metres <= 1e9f;
}
inline constexpr std::string_view integrates_env = "the reference integrates the environment";
inline bool hasEnv(const Settings& s) {
    return s.env != Settings().env;
}
constexpr bool isSide(int pixels) {
    return pixels >= 1 && pixels <= largest_side;
}
inline bool isFiniteFrom0(double value) {
    return value >= 0 && std::isfinite(value);
}
inline bool isReference(const Settings& s) {
    return diptych::isReference(s.path);
}
inline constexpr std::string_view needs_msaa = "has no effect without --msaa 4";
inline constexpr std::string_view own_samples = "the reference takes --spp samples per pixel";
inline bool hasMsaa(const Settings& s) {
    return s.msaa > 1;
}
inline bool hasOneSample(const Settings& s) {
    return !hasMsaa(s);
}
inline bool hasReferenceSamples(const Settings& s) {
    return isReference(s) && s.reference_mode == ReferenceMode::scene && s.spp > 1;
}
inline constexpr std::string_view needs_spec_aa = "has no effect without --spec-aa on";
inline constexpr std::string_view unfiltered =
    "the reference takes several samples instead of filtering roughness";
constexpr bool shadesCaptures(const Settings& s) {
    return s.reference_mode == ReferenceMode::surface;
}
inline bool hasSpecAa(const Settings& s) {
    return s.spec_aa;
}
inline bool hasShadows(const Settings& s) {
    return s.shadows != Shadows::off;
}
inline bool hasClipmap(const Settings& s) {
    return s.shadows == Shadows::clipmap;
}
inline bool hasCascades(const Settings& s) {
    return hasShadows(s) && !hasClipmap(s);
}
inline bool isShadowedForwardPlus(const Settings& s) {
    return shadesFragments(s.path) && hasShadows(s);  // its geometric normals are quantized, too
}
inline bool hasEvsm4(const Settings& s) {
    return s.shadows == Shadows::evsm4;
}
inline bool hasEvsm(const Settings& s) {
    return s.shadows == Shadows::evsm || hasEvsm4(s);
}
inline bool isExponent(const Settings& s, float exponent) {
    return exponent >= 0 && exponent <= (s.evsm_precision == EvsmPrecision::fp16 ? 5.54f : 44.36f);
}

}  // namespace diptych::row
