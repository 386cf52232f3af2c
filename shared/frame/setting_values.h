// SPDX-License-Identifier: MIT
// Value types of Settings: enumerations with their names, and small structs.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

namespace diptych {

template <class E>
using EnumName = std::pair<E, std::string_view>;

// Values of an enumeration with their names on the command line and in JSON, in the order of --help.
// Specialized below each enumeration.
template <class E>
inline constexpr std::array<EnumName<E>, 0> enum_names{};

template <class E>
constexpr std::span<const EnumName<E>> enumNames() {
    static_assert(!enum_names<E>.empty(), "an enumeration without names");
    return enum_names<E>;
}

// "?" for an invalid value.
template <class E>
constexpr std::string_view nameOf(E value) {
    for (const auto& [candidate, name] : enumNames<E>())
        if (candidate == value) return name;
    return "?";
}

enum class Path { deferred, forward_plus, reference };
template <>
inline constexpr auto enum_names<Path> = std::to_array<EnumName<Path>>({{Path::deferred, "deferred"},
                                                                        {Path::forward_plus, "forward_plus"},
                                                                        {Path::reference, "reference"}});

// Paths that a GPU renders, in comparison order.
inline constexpr std::array drawn_paths{Path::deferred, Path::forward_plus};
// The one of them that shades its own surfaces, decoded by no G-buffer; it explains what an encoding changes.
inline constexpr Path unencoded_path = drawn_paths[1];

// The other of the two.
constexpr Path otherPath(Path path) {
    return path == drawn_paths[0] ? drawn_paths[1] : drawn_paths[0];
}

// Abilities of a path. All other code asks this row instead of comparing Path values; path_table.h has the
// functions of paths that a device renders.
struct PathRow {
    Path path;
    std::string_view side;  // option with the path's own Settings
    bool drawn;             // by a device; else by rays, in double precision
    bool gbuffer;           // stores surfaces, and lights what it decodes
    bool fragments;         // lights the fragments of its own draws, with all that their vertices have
};
inline constexpr std::array path_rows{
    PathRow{.path = Path::deferred, .side = "--deferred", .drawn = true, .gbuffer = true, .fragments = false},
    PathRow{.path = Path::forward_plus,
            .side = "--forward-plus",
            .drawn = true,
            .gbuffer = false,
            .fragments = true},
    PathRow{.path = Path::reference, .side = {}, .drawn = false, .gbuffer = false, .fragments = false}};
constexpr const PathRow& pathRow(Path path) {
    return path_rows.at(static_cast<std::size_t>(path));
}
constexpr bool isReference(Path path) {
    return !pathRow(path).drawn;
}
constexpr bool hasGBuffer(Path path) {
    return pathRow(path).gbuffer;
}
constexpr bool shadesFragments(Path path) {
    return pathRow(path).fragments;
}

enum class Assignment { every, tiled, clustered, per_object };
template <>
inline constexpr auto enum_names<Assignment> =
    std::to_array<EnumName<Assignment>>({{Assignment::every, "every"},
                                         {Assignment::tiled, "tiled"},
                                         {Assignment::clustered, "clustered"},
                                         {Assignment::per_object, "per_object"}});

enum class LightKernel { automatic, scatter, gather };
template <>
inline constexpr auto enum_names<LightKernel> = std::to_array<EnumName<LightKernel>>(
    {{LightKernel::automatic, "auto"}, {LightKernel::scatter, "scatter"}, {LightKernel::gather, "gather"}});

enum class Switch { automatic, on, off };
template <>
inline constexpr auto enum_names<Switch> =
    std::to_array<EnumName<Switch>>({{Switch::automatic, "auto"}, {Switch::on, "on"}, {Switch::off, "off"}});

enum class GBufferEncoding { compact, standard, full };
template <>
inline constexpr auto enum_names<GBufferEncoding> =
    std::to_array<EnumName<GBufferEncoding>>({{GBufferEncoding::compact, "compact"},
                                              {GBufferEncoding::standard, "standard"},
                                              {GBufferEncoding::full, "full"}});

enum class AreaLights { ltc, representative };
template <>
inline constexpr auto enum_names<AreaLights> = std::to_array<EnumName<AreaLights>>(
    {{AreaLights::ltc, "ltc"}, {AreaLights::representative, "representative"}});

// device: 8-bit texels, decoded and filtered by the device. exact: decoded on the CPU to 16-bit and float
// texels. packed: as device, but opaque surfaces have roughness in the normal map's alpha and metallic in
// base colour's.
enum class TexturePrecision { device, exact, packed };
template <>
inline constexpr auto enum_names<TexturePrecision> =
    std::to_array<EnumName<TexturePrecision>>({{TexturePrecision::device, "device"},
                                               {TexturePrecision::exact, "exact"},
                                               {TexturePrecision::packed, "packed"}});

// Order of blended surfaces. sorted: draws far to near. unsorted: scene order. triangles: all triangles
// far to near. Order-independent: weighted, by depth; moments, by transmittance in front. list: sorted per
// fragment. off: not drawn.
enum class Transparency { sorted, unsorted, triangles, weighted, moments, list, off };
template <>
inline constexpr auto enum_names<Transparency> =
    std::to_array<EnumName<Transparency>>({{Transparency::sorted, "sorted"},
                                           {Transparency::unsorted, "unsorted"},
                                           {Transparency::triangles, "triangles"},
                                           {Transparency::weighted, "weighted"},
                                           {Transparency::moments, "moments"},
                                           {Transparency::list, "list"},
                                           {Transparency::off, "off"}});

// Where skinned and morphed vertices are deformed: once per frame in compute, or in the vertex shader of
// every draw.
enum class Skinning { compute, vertex };
template <>
inline constexpr auto enum_names<Skinning> =
    std::to_array<EnumName<Skinning>>({{Skinning::compute, "compute"}, {Skinning::vertex, "vertex"}});

// Transform of a skinned normal: the mean of the joints' inverse transposes, or the inverse transpose of
// the mean of their matrices. glTF does not specify it. Both agree for a vertex with one joint.
enum class SkinNormals { joints, blended };
template <>
inline constexpr auto enum_names<SkinNormals> = std::to_array<EnumName<SkinNormals>>(
    {{SkinNormals::joints, "joints"}, {SkinNormals::blended, "blended"}});

enum class SpecularAlbedo { table, fit };
template <>
inline constexpr auto enum_names<SpecularAlbedo> =
    std::to_array<EnumName<SpecularAlbedo>>({{SpecularAlbedo::table, "table"}, {SpecularAlbedo::fit, "fit"}});

// Light that reaches a dielectric's base below a coloured layer: 1 minus the largest component of F, or 1
// minus each component. glTF 2.0, appendix B, leaves this to implementations; the first preserves the
// base's hue.
enum class BaseLayer { max, component };
template <>
inline constexpr auto enum_names<BaseLayer> =
    std::to_array<EnumName<BaseLayer>>({{BaseLayer::max, "max"}, {BaseLayer::component, "component"}});

// Falloff of a spot from the inner to the outer angle, by t linear in the cosine, 1 at the inner angle:
// t^2 (KHR_lights_punctual), or t^2 (3 - 2 t).
enum class SpotFalloff { gltf, smoothstep };
template <>
inline constexpr auto enum_names<SpotFalloff> = std::to_array<EnumName<SpotFalloff>>(
    {{SpotFalloff::gltf, "gltf"}, {SpotFalloff::smoothstep, "smoothstep"}});

// Factor on a light's intensity at distance d: 1 - (d / range)^4 (KHR_lights_punctual), or its square
// (Karis 2013, "Real Shading in Unreal Engine 4").
enum class RangeWindow { gltf, squared };
template <>
inline constexpr auto enum_names<RangeWindow> =
    std::to_array<EnumName<RangeWindow>>({{RangeWindow::gltf, "gltf"}, {RangeWindow::squared, "squared"}});

enum class Multiscatter { off, energy, fdez, walk };
template <>
inline constexpr auto enum_names<Multiscatter> =
    std::to_array<EnumName<Multiscatter>>({{Multiscatter::off, "off"},
                                           {Multiscatter::energy, "energy"},
                                           {Multiscatter::fdez, "fdez"},
                                           {Multiscatter::walk, "walk"}});

// Storage of the scene's depth. d32f: reversed, 1 at the near plane, which suits the precision of floats.
// d32f_standard: 0 at the near plane. d24, d16: reversed integers, whose precision does not depend on the
// direction.
enum class DepthFormat { d32f, d32f_standard, d24, d16 };
template <>
inline constexpr auto enum_names<DepthFormat> =
    std::to_array<EnumName<DepthFormat>>({{DepthFormat::d32f, "d32f"},
                                          {DepthFormat::d32f_standard, "d32f-standard"},
                                          {DepthFormat::d24, "d24"},
                                          {DepthFormat::d16, "d16"}});

enum class LitFormat { fp32, fp16, b10g11r11 };
template <>
inline constexpr auto enum_names<LitFormat> = std::to_array<EnumName<LitFormat>>(
    {{LitFormat::fp32, "fp32"}, {LitFormat::fp16, "fp16"}, {LitFormat::b10g11r11, "b10g11r11"}});

// Shading of the deferred path's G-buffer: by a full-screen triangle, or in compute.
enum class Lighting { fragment, compute };
template <>
inline constexpr auto enum_names<Lighting> =
    std::to_array<EnumName<Lighting>>({{Lighting::fragment, "fragment"}, {Lighting::compute, "compute"}});

// How the deferred path draws materials with layers: into the G-buffer, or by the forward shader after
// deferred lighting.
enum class Layers { gbuffer, forward };
template <>
inline constexpr auto enum_names<Layers> = std::to_array<EnumName<Layers>>({{Layers::gbuffer, "gbuffer"},
                                                                            {Layers::forward, "forward"}});

enum class ShadingPrecision { fp32, fp16 };
template <>
inline constexpr auto enum_names<ShadingPrecision> = std::to_array<EnumName<ShadingPrecision>>(
    {{ShadingPrecision::fp32, "fp32"}, {ShadingPrecision::fp16, "fp16"}});

// Specular light of an environment.
enum class Ibl { split, sampled };
template <>
inline constexpr auto enum_names<Ibl> = std::to_array<EnumName<Ibl>>({{Ibl::split, "split"},
                                                                      {Ibl::sampled, "sampled"}});

enum class IblDiffuse { sh, sh_windowed, map };
template <>
inline constexpr auto enum_names<IblDiffuse> = std::to_array<EnumName<IblDiffuse>>(
    {{IblDiffuse::sh, "sh"}, {IblDiffuse::sh_windowed, "sh-windowed"}, {IblDiffuse::map, "map"}});

enum class Shadows { off, pcf, evsm, evsm4, msm4, pcss, clipmap };
template <>
inline constexpr auto enum_names<Shadows> = std::to_array<EnumName<Shadows>>({{Shadows::off, "off"},
                                                                              {Shadows::pcf, "pcf"},
                                                                              {Shadows::evsm, "evsm"},
                                                                              {Shadows::evsm4, "evsm4"},
                                                                              {Shadows::msm4, "msm4"},
                                                                              {Shadows::pcss, "pcss"},
                                                                              {Shadows::clipmap, "clipmap"}});

enum class ShadowFit { view, depth };
template <>
inline constexpr auto enum_names<ShadowFit> =
    std::to_array<EnumName<ShadowFit>>({{ShadowFit::view, "view"}, {ShadowFit::depth, "depth"}});

enum class ShadowCasters { needed, all };
template <>
inline constexpr auto enum_names<ShadowCasters> =
    std::to_array<EnumName<ShadowCasters>>({{ShadowCasters::needed, "needed"}, {ShadowCasters::all, "all"}});

enum class EvsmPrecision { automatic, fp32, fp16 };
template <>
inline constexpr auto enum_names<EvsmPrecision> = std::to_array<EnumName<EvsmPrecision>>(
    {{EvsmPrecision::automatic, "auto"}, {EvsmPrecision::fp32, "fp32"}, {EvsmPrecision::fp16, "fp16"}});

enum class EvsmDepth { from_zero, from_minus_one };
template <>
inline constexpr auto enum_names<EvsmDepth> = std::to_array<EnumName<EvsmDepth>>(
    {{EvsmDepth::from_zero, "0..1"}, {EvsmDepth::from_minus_one, "-1..1"}});

// Shading rate of a fragment with MSAA: once for all covered samples, or for each.
enum class MsaaShading { pixel, sample };
template <>
inline constexpr auto enum_names<MsaaShading> =
    std::to_array<EnumName<MsaaShading>>({{MsaaShading::pixel, "pixel"}, {MsaaShading::sample, "sample"}});

// Samples of a pixel that deferred lighting shades separately: all; samples with different G-buffer bits;
// samples that differ visibly; samples of pixels that no triangle covers completely.
enum class MsaaEdges { all, exact, similar, coverage };
template <>
inline constexpr auto enum_names<MsaaEdges> =
    std::to_array<EnumName<MsaaEdges>>({{MsaaEdges::all, "all"},
                                        {MsaaEdges::exact, "exact"},
                                        {MsaaEdges::similar, "similar"},
                                        {MsaaEdges::coverage, "coverage"}});

// Mean of a pixel's samples: of their radiance, or weighted by a tone curve.
enum class Resolve { linear, tonemapped };
template <>
inline constexpr auto enum_names<Resolve> =
    std::to_array<EnumName<Resolve>>({{Resolve::linear, "linear"}, {Resolve::tonemapped, "tonemapped"}});

// Normal whose screen-space variation specular antialiasing filters: the interpolated normal, or the
// normal-mapped one.
enum class SpecularNormals { geometry, mapped };
template <>
inline constexpr auto enum_names<SpecularNormals> = std::to_array<EnumName<SpecularNormals>>(
    {{SpecularNormals::geometry, "geometry"}, {SpecularNormals::mapped, "mapped"}});

// How roughness grows with this variation: alpha^2 by its variance within a pixel (Tokuyoshi and Kaplanyan
// 2019), or perceptual roughness by its largest component, as in three.js.
enum class SpecularKernel { variance, slope };
template <>
inline constexpr auto enum_names<SpecularKernel> = std::to_array<EnumName<SpecularKernel>>(
    {{SpecularKernel::variance, "variance"}, {SpecularKernel::slope, "slope"}});

enum class ReferenceMode { surface, scene };
template <>
inline constexpr auto enum_names<ReferenceMode> = std::to_array<EnumName<ReferenceMode>>(
    {{ReferenceMode::surface, "surface"}, {ReferenceMode::scene, "scene"}});

struct Size {
    int width = 640, height = 360;  // pixels
    bool operator==(const Size&) const = default;
};

struct Rgb {
    float r = 0, g = 0, b = 0;
    bool operator==(const Rgb&) const = default;
};

}  // namespace diptych
