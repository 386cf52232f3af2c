// SPDX-License-Identifier: MIT
// The kinds of value that a Setting may have: enumerations, each with its names, and small structs.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace diptych {

template <class E>
using EnumName = std::pair<E, std::string_view>;

// The values of an enumeration and their names on the command line and in JSON, in the order of --help.
// Specialised below each enumeration.
template <class E>
inline constexpr std::array<EnumName<E>, 0> enum_names{};

template <class E>
constexpr std::span<const EnumName<E>> enumNames() {
    static_assert(!enum_names<E>.empty(), "an enumeration without names");
    return enum_names<E>;
}

// "?" of what is no value of the enumeration.
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

// The paths that a device draws, in the order in which they are compared.
inline constexpr std::array drawn_paths{Path::deferred, Path::forward_plus};

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

// Texels of 8 bits as the device decodes and filters them; decoded to 16 bits and floats before upload; or as
// the device does, of opaque surfaces with roughness in the normal map's alpha and metallic in base colour's.
enum class TexturePrecision { device, exact, packed };
template <>
inline constexpr auto enum_names<TexturePrecision> =
    std::to_array<EnumName<TexturePrecision>>({{TexturePrecision::device, "device"},
                                               {TexturePrecision::exact, "exact"},
                                               {TexturePrecision::packed, "packed"}});

// How blended surfaces are put in order: sorted, draws from far to near; unsorted, as in the scene;
// triangles, those of all draws from far to near. By sums that need no order: weighted, by depth; moments, by
// what is in front. list: by fragment. off: not drawn.
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

// Where the vertices of skinned and morphed meshes are posed: once a frame by a kernel, or at every draw by
// the vertex shader.
enum class Skinning { compute, vertex };
template <>
inline constexpr auto enum_names<Skinning> =
    std::to_array<EnumName<Skinning>>({{Skinning::compute, "compute"}, {Skinning::vertex, "vertex"}});

// What turns the normal of a skinned vertex: the mean of its joints' inverse transposes, or the inverse
// transpose of the mean of their matrices. glTF leaves it open; both agree where a vertex follows one joint.
enum class SkinNormals { joints, blended };
template <>
inline constexpr auto enum_names<SkinNormals> = std::to_array<EnumName<SkinNormals>>(
    {{SkinNormals::joints, "joints"}, {SkinNormals::blended, "blended"}});

enum class SpecularAlbedo { table, fit };
template <>
inline constexpr auto enum_names<SpecularAlbedo> =
    std::to_array<EnumName<SpecularAlbedo>>({{SpecularAlbedo::table, "table"}, {SpecularAlbedo::fit, "fit"}});

// What is left to a dielectric's base of light that its layer reflects a coloured part of: 1 less the largest
// component of F, or less each (glTF 2.0, appendix B, leaves both open to implementations; the first keeps
// the base's hue).
enum class BaseLayer { max, component };
template <>
inline constexpr auto enum_names<BaseLayer> =
    std::to_array<EnumName<BaseLayer>>({{BaseLayer::max, "max"}, {BaseLayer::component, "component"}});

// How a spot's light falls from the inner to the outer angle, t being the share of the way back in cosines:
// t^2 (KHR_lights_punctual), or t^2 (3 - 2 t).
enum class SpotFalloff { gltf, smoothstep };
template <>
inline constexpr auto enum_names<SpotFalloff> = std::to_array<EnumName<SpotFalloff>>(
    {{SpotFalloff::gltf, "gltf"}, {SpotFalloff::smoothstep, "smoothstep"}});

// What of a light's intensity is left at the distance d: 1 - (d / range)^4 (KHR_lights_punctual), or its
// square (Karis 2013, "Real Shading in Unreal Engine 4").
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

// How the depth of the scene's nearest surfaces is stored. d32f: reversed, 1 at the near plane, so that the
// steps of a float are small where those of 1 / distance are; d32f_standard: 0 at the near plane; d24, d16:
// equal steps, where turning them round changes nothing.
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

// What shades the deferred path's G-buffer: fragments of a full-screen triangle, or workgroups of threads.
enum class Lighting { fragment, compute };
template <>
inline constexpr auto enum_names<Lighting> =
    std::to_array<EnumName<Lighting>>({{Lighting::fragment, "fragment"}, {Lighting::compute, "compute"}});

enum class ShadingPrecision { fp32, fp16 };
template <>
inline constexpr auto enum_names<ShadingPrecision> = std::to_array<EnumName<ShadingPrecision>>(
    {{ShadingPrecision::fp32, "fp32"}, {ShadingPrecision::fp16, "fp16"}});

// How the specular lobe takes light of an environment.
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

// What a fragment shades with several samples a pixel: once for all that its triangle covers, or each of
// them.
enum class MsaaShading { pixel, sample };
template <>
inline constexpr auto enum_names<MsaaShading> =
    std::to_array<EnumName<MsaaShading>>({{MsaaShading::pixel, "pixel"}, {MsaaShading::sample, "sample"}});

// The samples of a pixel that deferred lighting shades each for itself: all; those that differ in any bit of
// the G-buffer; those that differ by more than is seen; those of pixels that one triangle does not cover.
enum class MsaaEdges { all, exact, similar, coverage };
template <>
inline constexpr auto enum_names<MsaaEdges> =
    std::to_array<EnumName<MsaaEdges>>({{MsaaEdges::all, "all"},
                                        {MsaaEdges::exact, "exact"},
                                        {MsaaEdges::similar, "similar"},
                                        {MsaaEdges::coverage, "coverage"}});

// The mean of a pixel's samples: of their radiance, or weighted by what a tone curve leaves of it.
enum class Resolve { linear, tonemapped };
template <>
inline constexpr auto enum_names<Resolve> =
    std::to_array<EnumName<Resolve>>({{Resolve::linear, "linear"}, {Resolve::tonemapped, "tonemapped"}});

// Whose changes from pixel to pixel specular anti-aliasing filters: the interpolated normal, or the one that
// a normal map has turned.
enum class SpecularNormals { geometry, mapped };
template <>
inline constexpr auto enum_names<SpecularNormals> = std::to_array<EnumName<SpecularNormals>>(
    {{SpecularNormals::geometry, "geometry"}, {SpecularNormals::mapped, "mapped"}});

// How roughness grows with these changes: alpha^2 by their variance within a pixel (Tokuyoshi and Kaplanyan
// 2019), or perceptual roughness by the largest of them, as three.js has it.
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
