// SPDX-License-Identifier: MIT
#include "compare/verdict/tolerance.h"

#include "compare/metrics/pixel.h"
#include "compare/reference/channels.h"
#include "compare/reference/reference.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/neighbours.h"
#include "shared/contract/constants.h"
#include "shared/contract/debug_mode.h"
#include "shared/contract/gbuffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace diptych {
namespace {

// Tolerance of values with an exponent: half a step relative to the value, or half of the smallest step,
// which is `min`.
Tolerance floatTolerance(const DebugMode& mode, const FramePair& pair, const Tolerance& relative,
                         const Tolerance& min) {
    const Image& baseline = pair.baseline.channels.at(mode.channel);
    const double floor = PixelError(mode.error_kind, mode.kind, baseline, pair.coverage).floor();
    const double smallest = floor > 0 ? min.max / floor : 0;
    return smallest > relative.max ? Tolerance{smallest, min.because} : relative;
}

// Tolerance of an index of refraction: the bound of the largest one. Deferred's own indices, which are
// decoded, do not widen it.
Tolerance indexTolerance(unsigned bits, const DebugMode& mode, const FramePair& pair) {
    const Frame& own = hasGBuffer(pair.baseline.settings.path) ? pair.test : pair.baseline;
    const Image& image = own.channels.at(mode.channel);
    double largest = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
        if (pair.coverage.covered[i]) largest = std::max(largest, metrics::largestFinite(image.pixel(i), 1));
    return {largest > 0 ? indexBound(largest, bits) : 0,
            fmt::format("(n - 1) / (n + 1) in {} bits: half a step, 0.5 / {}, of the largest index n, {:.4g}",
                        bits, (1u << bits) - 2, largest)};
}

Tolerance storedTolerance(const StoredField& field, const DebugMode& mode, const FramePair& pair) {
    const unsigned bits = field.bits, codes = (1u << bits) - 1;
    const auto bounded = [&](std::string because) {
        return Tolerance{field.largestBound(), std::move(because)};
    };
    switch (field.code) {
        case StoredField::Code::exact:
            break;
        case StoredField::Code::unorm:
            return bounded(fmt::format("half a step of {} bits, 0.5 / {}", bits, codes));
        case StoredField::Code::root:
            return bounded(
                fmt::format("square root in {} bits: 2h - h^2 with half a step h = 0.5 / {}", bits, codes));
        case StoredField::Code::octahedral:
            return bounded(fmt::format(
                "octahedral in {0}+{0} bits: half a step in both at a face's centre, degrees", bits));
        case StoredField::Code::line:
            return bounded(
                fmt::format("its plane turns with the octahedral normal in {0}+{0} bits; across that, half "
                            "a step of an angle in {1} bits, 180 / 2^{2}; degrees",
                            field.normal_bits, bits, bits + 1));
        case StoredField::Code::radiance:
            return floatTolerance(
                mode, pair,
                bounded(fmt::format("half a step of a {}-bit mantissa whose top bit is set, 0.5 / {}", bits,
                                    1u << (bits - 1))),
                {radianceBound(bits).min,
                 fmt::format("half of {0}.{0}.{0}.e{1}'s smallest step, 2^-{2}, at the darkest pixel", bits,
                             gpu::EMISSION_EXPONENT_BITS, gpu::EMISSION_BIAS + bits + 1)});
        case StoredField::Code::index:
            return indexTolerance(bits, mode, pair);
        case StoredField::Code::half:
            return floatTolerance(
                mode, pair,
                bounded(fmt::format("half a step of a half's {}-bit mantissa, 2^-{}",
                                    bits - gpu::HALF_EXPONENT_BITS, bits - gpu::HALF_EXPONENT_BITS + 1)),
                {halfBound(bits).min, fmt::format("half of a half's smallest step, 2^-{}", bits + 10)});
    }
    return {};
}

// mix(dielectric F0, albedo, metallic): the larger bound of the two ends, plus metallic's step times their
// distance.
Tolerance specularTolerance(const FramePair& pair, GBufferEncoding encoding) {
    const auto bound = [&](Channel mode) {
        const auto field = storedField(mode, encoding, pair.needs);
        return field ? field->largestBound() : 0;
    };
    const double metallic = bound(Channel::metallic), f0 = bound(Channel::dielectric_f0);
    const double ends = std::max(bound(Channel::albedo), f0);
    const double range = f0 > 0 ? 1 : 1 - double{gpu::DEFAULT_DIELECTRIC_F0};
    return {ends + metallic * range,
            fmt::format("mixed from albedo{} (sqrt in {} bits, {:.3g}) by metallic (half a step, {:.3g})",
                        f0 > 0 ? " and F0" : "",
                        f0 > bound(Channel::albedo) ? gpu::SPECULAR_BITS : gpu::ALBEDO_BITS, ends, metallic)};
}

// The image that forward+ shades from surfaces after the same encoding; nullptr if it was not rendered.
const Image* throughGBuffer(const DebugMode& mode, const FramePair& pair) {
    const Frame *deferred = pair.of(hasGBuffer), *forward = pair.of(shadesFragments);
    if (!isLit(mode.channel) || !deferred || !forward ||
        deferred->settings.gbuffer != forward->settings.gbuffer)
        return nullptr;
    return findChannel(forward->through_gbuffer, mode.channel);
}

Tolerance litTolerance(const DebugMode& mode, const FramePair& pair) {
    const Image* const through = throughGBuffer(mode, pair);
    if (!through)
        return {0,
                "forward+ was not rendered through this G-buffer's encoding, so it explains no difference"};
    const Image& own = pair.of(shadesFragments)->channels.at(mode.channel);
    const bool first = shadesFragments(pair.baseline.settings.path);
    const ChannelStats moved = channelStats(mode.error_kind, mode.kind, first ? own : *through,
                                            first ? *through : own, pair.coverage);
    return {moved.max,
            fmt::format("decoded surfaces change lit by up to {:.3g} (mean {:.3g}): forward+ shades its own "
                        "surfaces through the {} G-buffer's encoding; deferred must equal that {}, and each "
                        "surface channel must be within its bits",
                        moved.max, moved.mean, nameOf(pair.of(shadesFragments)->settings.gbuffer),
                        pair.cpu ? "bit for bit" : "within 16 ULP")};
}

// Why a part of materials that no packed field stores has no error; empty: not for this reason.
std::string_view unpackedBecause(const DebugMode& mode, const Requirements& needs) {
    const MaterialPart part = sourceOf(mode.channel).part;
    if (part == MaterialPart::emission && needs.emission)
        return "float32: the scene's emission exceeds the range of 9.9.9.e5";
    if (part == MaterialPart::lightmap && needs.lightmap)
        return "float32: the scene's lightmaps exceed the range of 9.9.9.e5";
    if (mode.channel == Channel::dielectric_f90) return "every dielectric has F90 = 1: nothing is stored";
    static constexpr std::pair<MaterialPart, std::string_view> reasons[] = {
        {MaterialPart::emission, "nothing in the scene emits"},
        {MaterialPart::lightmap, "nothing in the scene has a lightmap"},
        {MaterialPart::dielectric, "every dielectric has F0 = 0.04: nothing is stored"},
        {MaterialPart::clearcoat, "nothing in the scene has a clear coat"},
        {MaterialPart::anisotropy, "nothing in the scene is anisotropic"},
        {MaterialPart::sheen, "nothing in the scene has a sheen"},
        {MaterialPart::iridescence, "nothing in the scene has a thin film"},
        {MaterialPart::diffuse_transmission, "nothing in the scene transmits light diffusely"},
        {MaterialPart::transmission,
         "surfaces with transmission are drawn after either path, by the same shader"}};
    const auto found = std::ranges::find(reasons, part, [](const auto& row) { return row.first; });
    return found == std::end(reasons) ? std::string_view() : found->second;
}

// Why both paths have equal values of a channel that no field stores.
std::string_view equalBecause(const DebugMode& mode) {
    switch (sourceOf(mode.channel).stage) {
        case ChannelStage::id:
            return "the index is stored exactly";
        case ChannelStage::list:
            return mode.supported_by == SupportedBy::deferred_only
                       ? "the same samples of one G-buffer are shaded"
                       : "both paths use one list, chosen by the same function of pixel and depth";
        case ChannelStage::position:
        case ChannelStage::haze:
            return "the same function of pixel and depth in both paths";
        case ChannelStage::map:
        case ChannelStage::visibility:
            return "the same maps, read at the same positions along the same normals";
        default:
            return mode.channel == Channel::lightmapped ? "it is stored exactly"
                                                        : "no loss of precision is known here";
    }
}

Tolerance encodingTolerance(const DebugMode& mode, const FramePair& pair, GBufferEncoding encoding) {
    if (encoding == GBufferEncoding::full) return {0, "the full G-buffer stores float32 exactly"};
    if (isLit(mode.channel)) return litTolerance(mode, pair);
    if (const auto field = storedField(mode.channel, encoding, pair.needs))
        return storedTolerance(*field, mode, pair);
    if (mode.channel == Channel::specular) return specularTolerance(pair, encoding);
    const std::string_view unpacked = unpackedBecause(mode, pair.needs);
    return {0, std::string(unpacked.empty() ? equalBecause(mode) : unpacked)};
}

// Times the number of steps, as a fraction of the light that haze scatters: the measured error of ray
// marching. At most 0.03, in builtin:deep through three times the earth's air, with 8, 32 and 128 steps;
// the error falls faster than that.
constexpr double marchFraction = 0.1;

bool isMarched(const DebugMode& mode, const Settings& path) {
    return path.haze && path.haze_march_steps > 0 &&
           (mode.channel == Channel::lit || mode.channel == Channel::lit_haze);
}

// Permitted error of a channel at the pixel by ray-marching haze, W/(sr m^2). Uses lit, which is no less,
// if the reference's lit_haze is missing.
double marchAllowed(const DebugMode& mode, const FramePair& pair, std::size_t pixel) {
    const Settings& path = pair.path().settings;
    if (!isMarched(mode, path)) return 0;
    const Image* const scattered = findChannel(pair.reference(), Channel::lit_haze);
    const Image& image = scattered ? *scattered : pair.reference().channels.at(mode.channel);
    return marchFraction / path.haze_march_steps *
           metrics::largestFinite(image.pixel(pixel), image.components);
}

// Tolerance of a path against the reference: the losses of its encoding and of float32.
Tolerance referenceTolerance(const DebugMode& mode, const FramePair& pair) {
    const Frame &reference = pair.reference(), &path = pair.path();
    Tolerance result;
    if (isLit(mode.channel)) {
        result = {shadingRounding, "float32 shading against double, 1e-4"};
        if (!reference.rounding.empty())
            result.because +=
                " or, where light grazes, nears its range or meets a sharp lobe, what float32 "
                "positions err by";
        if (const Frame* const shown = encodingFrame(mode, pair))
            result.because += fmt::format("; on the surfaces that the {} G-buffer decodes, as {} shades them",
                                          nameOf(path.settings.gbuffer), shown->name);
        if (ShadowEdges(pair).any())
            result.because +=
                "; plus a shadow-casting light's contribution where its shadow boundary lies within the "
                "filter radius and one texel";
        if (const EnvironmentCost environment(pair); environment.any())
            result.because += environment.because(mode);
        const bool shown = mode.channel == Channel::lit || mode.channel == Channel::lit_transmission;
        if (const BlendedPixels blended(pair); shown && blended.any()) {
            result.because +=
                "; plus the image's change within two pixels where fragments are blended or glass stands, "
                "because the reference traces its own rays";
            if (blended.anyGlass()) result.because += fmt::format("; plus {}", throughGlassBecause);
        }
        if (!reference.uncertainty.empty())
            result.because += "; plus the reference's uncertainty at each pixel, at 99.9 % confidence";
    } else {
        // Surfaces come from forward+'s own capture.
        result = isPacked(path.settings) ? encodingTolerance(mode, pair, path.settings.gbuffer)
                                         : Tolerance{0, "float32, nothing is packed"};
        if (BlendedPixels::isOfGlass(mode))
            result = {shadingRounding,
                      "float32 against double, 1e-4; plus the image's change within two pixels and one code "
                      "of a texture, because the reference traces these surfaces itself"};
        static const std::pair<Channel, Tolerance> others[] = {
            {Channel::transmittance, {1e-6, "float32 against quadrature in double, 1e-6"}},
            {Channel::lit_haze, {shadingRounding, "float32 against quadrature in double, 1e-4"}},
            {Channel::shadow_visibility,
             {0,
              "farther than the filter radius and one texel from a shadow boundary, visibility is 0 or 1"}},
            {Channel::local_visibility,
             {shadingRounding,
              "float32 weights against double, 1e-4; farther than the filter radius and one texel from a "
              "shadow boundary, a light's visibility is 0 or 1"}}};
        for (const auto& [channel, tolerance] : others)
            if (mode.channel == channel) result = tolerance;
    }
    if (isMarched(mode, path.settings))
        result.because +=
            fmt::format("; plus the error of {} steps through haze, {:.2g} % of its light",
                        path.settings.haze_march_steps, 100 * marchFraction / path.settings.haze_march_steps);
    result.max_pixels = true;
    return result;
}

}  // namespace

const Frame* encodingFrame(const DebugMode& mode, const FramePair& pair) {
    if (!isLit(mode.channel) || !isPathAgainstReference(pair)) return nullptr;
    const Settings& path = pair.path().settings;
    if (!isPacked(path)) return nullptr;
    if (pair.reference().through_gbuffer.contains(mode.channel)) return &pair.reference();
    const Frame* const forward = pair.explaining;
    return forward && forward->settings.gbuffer == path.gbuffer &&
                   forward->through_gbuffer.contains(mode.channel)
               ? forward
               : nullptr;
}

double gpuSlack(const DebugMode& mode, const Image& baseline) {
    constexpr double fraction = gpuUlps * 0x1p-23;
    switch (mode.error_kind) {
        case ErrorKind::relative:
            return fraction;
        case ErrorKind::absolute: {
            float largest = 0;
            for (const float v : baseline.data)
                if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
            return fraction * double{largest};
        }
        case ErrorKind::angular:
        case ErrorKind::axial:
            return std::sqrt(3.0) * fraction * degreesPerRadian;
        case ErrorKind::exact:
            return 0;
    }
    return 0;
}

Tolerance derivedTolerance(const DebugMode& mode, const FramePair& pair) {
    const Frame* deferred = pair.of(hasGBuffer);
    if (pair.baseline.origin.external || pair.test.origin.external)
        return {0, "an external renderer's image has no derived tolerance: give rules (--tolerances)"};
    Tolerance result{0, "one path twice: the same function of the same inputs"};
    if (deferred && pair.of(shadesFragments))
        result = encodingTolerance(mode, pair, deferred->settings.gbuffer);
    else if (pair.hasReference())
        result = referenceTolerance(mode, pair);
    else if (pair.baseline.settings.path != pair.test.settings.path)
        result = {0, "no bound is known between these two paths"};
    if (!pair.cpu && mode.error_kind != ErrorKind::exact) {
        result.max += gpuSlack(mode, pair.baseline.channels.at(mode.channel));
        result.because += fmt::format("; plus {} ULP of the pixel's largest component on a GPU", gpuUlps);
        const Frame* const forward = pair.of(shadesFragments);
        if (deferred && forward && forward->settings.prepass != Switch::on &&
            (isLit(mode.channel) || mode.channel == Channel::depth || mode.channel == Channel::position))
            result.because +=
                "; without a depth pre-pass, forward+ shades with the fragment's own depth, which may differ "
                "from the stored depth";
    }
    return result;
}

double encodingBound(const DebugMode& mode, const FramePair& pair) {
    const Settings& path = pair.path().settings;
    return isLit(mode.channel) || !isPacked(path) ? 0 : encodingTolerance(mode, pair, path.gbuffer).max;
}

bool Allowances::any() const {
    const Settings& path = pair_.path().settings;
    return edges_.any() || environment_.any() || blended_.any() || (path.haze && path.haze_march_steps > 0);
}

std::array<double, approximations> Allowances::at(const DebugMode& mode, std::size_t pixel) const {
    return {edges_.any() ? edges_.allowed(mode, pixel) : 0, environment_.allowedDiffuse(mode, pixel),
            environment_.allowedSpecular(mode, pixel), blended_.allowed(mode, pixel),
            marchAllowed(mode, pair_, pixel)};
}

std::optional<std::vector<double>> certainErrors(const DebugMode& mode, const FramePair& pair) {
    if (!(isShaded(mode.channel) || BlendedPixels::isOfGlass(mode)) || !isPathAgainstReference(pair))
        return {};
    const Frame& reference = pair.reference();
    if (reference.uncertainty.empty() && reference.rounding.empty() && !encodingFrame(mode, pair) &&
        !Allowances(pair).any())
        return {};
    return openErrors(mode, pair, pair.baseline.channels.at(mode.channel),
                      pair.test.channels.at(mode.channel));
}

std::vector<double> openErrors(const DebugMode& mode, const FramePair& pair, const Image& baseline,
                               const Image& test) {
    const Frame& reference = pair.reference();
    const Frame* const encoded = encodingFrame(mode, pair);
    const bool first = isReferenceFrame(pair.baseline);
    const Allowances allowances(pair);
    const PixelError error(mode.error_kind, mode.kind, baseline, pair.coverage);
    std::vector<double> errors;
    for (std::size_t i = 0; i < baseline.pixels(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const float *p = baseline.pixel(i), *q = test.pixel(i);
        double open =
            reference.rounding.empty() ? 0 : reference::roundingOf(mode.channel, reference.rounding.pixel(i));
        for (const double allowed : allowances.at(mode, i)) open += allowed;
        if (isLit(mode.channel) && !reference.uncertainty.empty())
            open += surerThan95 * double{reference.uncertainty.pixel(i)[0]};
        if (mode.error_kind == ErrorKind::relative)
            open /= std::max(metrics::largestFinite(p, baseline.components), error.floor());
        // Removes the encoding's effect on light from the path's pixel.
        std::array<float, 3> moved{};
        if (encoded) {
            const float *before = encoded->channels.at(mode.channel).pixel(i),
                        *after = encoded->through_gbuffer.at(mode.channel).pixel(i);
            const float*& path = first ? q : p;
            for (std::size_t c = 0; c < 3; ++c) moved.at(c) = path[c] - (after[c] - before[c]);
            path = moved.data();
        }
        const double e = error(q, p);
        // An infinite error (NaN against a number) stays infinite, whatever the uncertainty.
        errors.push_back(std::isinf(e) ? e : std::max(0.0, e - open));
    }
    return errors;
}

double nearestRank(std::vector<double> values, double fraction) {
    if (values.empty()) return 0;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(fraction * static_cast<double>(values.size()))) - 1;
    std::ranges::nth_element(values, values.begin() + rank);
    return values.begin()[rank];
}

std::optional<std::uint64_t> unexplainedPixels(const DebugMode& mode, const FramePair& pair) {
    const Image* through = throughGBuffer(mode, pair);
    if (!through) return {};
    return unequalPixels(pair.of(hasGBuffer)->channels.at(mode.channel), *through, pair.cpu ? 0 : gpuUlps);
}

std::optional<bool> encodingExplains(const DebugMode& mode, const FramePair& pair, std::size_t pixel) {
    const Image* through = throughGBuffer(mode, pair);
    if (!through) return {};
    const Image& read = pair.of(hasGBuffer)->channels.at(mode.channel);
    return unequalPixels(onePixel(read, pixel), onePixel(*through, pixel), pair.cpu ? 0 : gpuUlps) == 0;
}

}  // namespace diptych
