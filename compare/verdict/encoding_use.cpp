// SPDX-License-Identifier: MIT
#include "compare/verdict/encoding_use.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/encoding_bits.h"
#include "shared/contract/gbuffer.h"
#include "shared/material/gbuffer_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace diptych {
namespace {

constexpr std::array fields{
    static_cast<int>(gpu::DEBUG_albedo),         static_cast<int>(gpu::DEBUG_normals),
    static_cast<int>(gpu::DEBUG_metallic),       static_cast<int>(gpu::DEBUG_roughness),
    static_cast<int>(gpu::DEBUG_emission),       static_cast<int>(gpu::DEBUG_occlusion),
    static_cast<int>(gpu::DEBUG_position),       static_cast<int>(gpu::DEBUG_geometric_normal),
    static_cast<int>(gpu::DEBUG_dielectric_f90), static_cast<int>(gpu::DEBUG_lightmap),
    static_cast<int>(gpu::DEBUG_dielectric_f0),  static_cast<int>(gpu::DEBUG_lightmapped)};

using FieldBound = std::function<PixelUse(const float* read, const float* own)>;

// A field in [0, 1]; each component's bound depends on its value. 0 and 1 are exact.
template <class Bound>
FieldBound unitField(int components, double slack, const Bound& bound) {
    return [=](const float* read, const float* own) {
        PixelUse used;
        for (int c = 0; c < components; ++c) {
            const double x = own[c], most = (x <= 0 || x >= 1 ? 0 : bound(x)) + slack;
            const PixelUse here = pixelUse(metrics::distance(read[c], own[c]), most);
            used = {std::max(used.share, here.share), std::max(used.bound, most)};
        }
        return used;
    };
}
FieldBound unormField(unsigned bits, double slack) {
    return unitField(1, slack, [bits](double) { return unormBound(bits); });
}
FieldBound rootField(unsigned bits, double slack) {
    return unitField(3, slack, [bits](double x) { return squareBound(x, bits); });
}

// A direction; errors are angles in degrees.
FieldBound directionField(unsigned bits, double slack) {
    return [most = octahedralBound(bits) + slack](const float* read, const float* own) {
        const bool finite = metrics::finite(read, 3) && metrics::finite(own, 3);
        return pixelUse(finite ? metrics::angle(read, own) : metrics::distance(read, own, 3), most);
    };
}

// Radiance in 9.9.9.e5; the bound is relative to its largest component.
FieldBound radianceField(double slack) {
    return [slack](const float* read, const float* own) {
        const double size = metrics::largestFinite(own, 3);
        const double most =
            size > 0 ? std::max(size * radianceBound(), leastRadianceBound) + size * slack : 0;
        return PixelUse{pixelUse(metrics::distance(read, own, 3), most).share, size > 0 ? most / size : 0};
    };
}

FieldBound boundOf(const DebugMode& mode, GBufferEncoding encoding, const Requirements& needs, double slack) {
    const bool compact = encoding == GBufferEncoding::compact;
    const GBufferLayout layout = gbufferLayout(encoding, needs);
    switch (static_cast<gpu::uint>(mode.number)) {
        case gpu::DEBUG_albedo:
            return rootField(gpu::ALBEDO_BITS, slack);
        case gpu::DEBUG_normals:
            return directionField(compact ? gpu::COMPACT_NORMAL_BITS : gpu::STANDARD_NORMAL_BITS, slack);
        case gpu::DEBUG_geometric_normal:
            return directionField(compact ? gpu::COMPACT_GEOMETRIC_NORMAL_BITS : gpu::STANDARD_NORMAL_BITS,
                                  slack);
        case gpu::DEBUG_metallic:
            return unormField(compact ? gpu::COMPACT_METALLIC_BITS : gpu::STANDARD_METALLIC_BITS, slack);
        case gpu::DEBUG_roughness:
            return unormField(compact ? gpu::COMPACT_ROUGHNESS_BITS : gpu::STANDARD_ROUGHNESS_BITS, slack);
        case gpu::DEBUG_occlusion:
            return unormField(gpu::OCCLUSION_BITS, slack);
        case gpu::DEBUG_emission:
            return needs.emission && !layout.wide_emission ? radianceField(slack) : FieldBound();
        case gpu::DEBUG_lightmap:
            return needs.lightmap && !layout.wide_lightmap ? radianceField(slack) : FieldBound();
        case gpu::DEBUG_dielectric_f90:
            return needs.dielectric_specular ? unormField(gpu::SPECULAR_BITS, slack) : FieldBound();
        case gpu::DEBUG_dielectric_f0:
            return needs.dielectric_specular ? rootField(gpu::SPECULAR_BITS, slack) : FieldBound();
        default:
            return {};
    }
}

}  // namespace

std::span<const int> lightingFields() {
    return fields;
}

std::optional<BoundUse> encodingUse(const DebugMode& mode, const FramePair& pair, double slack) {
    const Frame *deferred = pair.of(Path::deferred), *forward = pair.of(Path::forward_plus);
    if (!deferred || !forward || deferred->settings.gbuffer == GBufferEncoding::full) return {};
    const FieldBound bound = boundOf(mode, deferred->settings.gbuffer, pair.needs, slack);
    if (!bound) return {};
    const Image &read = deferred->channels.at(mode.number), &own = forward->channels.at(mode.number);
    return boundUse(pair.coverage, own.width,
                    [&](std::size_t i) { return bound(read.pixel(i), own.pixel(i)); });
}

}  // namespace diptych
