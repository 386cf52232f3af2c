// SPDX-License-Identifier: MIT
// Value types of Settings: enumerations with their names, and small structs.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace diptych {

template <class E>
struct EnumName {
    E value;
    std::string_view name;
};

// Values of an enumeration with their names on the command line and in JSON, in the order of --help.
// Specialized below each enumeration.
template <class E>
extern const EnumName<E> enum_names[];

template <class E>
constexpr std::span<const EnumName<E>> enumNames() {
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
inline constexpr EnumName<Path> enum_names<Path>[] = {
    {Path::deferred, "deferred"}, {Path::forward_plus, "forward_plus"}, {Path::reference, "reference"}};

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
inline constexpr EnumName<Assignment> enum_names<Assignment>[] = {{Assignment::every, "every"},
                                                                  {Assignment::tiled, "tiled"},
                                                                  {Assignment::clustered, "clustered"},
                                                                  {Assignment::per_object, "per_object"}};

enum class LightKernel { automatic, scatter, gather };
template <>
inline constexpr EnumName<LightKernel> enum_names<LightKernel>[] = {
    {LightKernel::automatic, "auto"}, {LightKernel::scatter, "scatter"}, {LightKernel::gather, "gather"}};

enum class Switch { automatic, on, off };
template <>
inline constexpr EnumName<Switch> enum_names<Switch>[] = {
    {Switch::automatic, "auto"}, {Switch::on, "on"}, {Switch::off, "off"}};

enum class GBufferEncoding { compact, standard, full };
template <>
inline constexpr EnumName<GBufferEncoding> enum_names<GBufferEncoding>[] = {
    {GBufferEncoding::compact, "compact"},
    {GBufferEncoding::standard, "standard"},
    {GBufferEncoding::full, "full"}};

enum class AreaLights { ltc, representative };
template <>
inline constexpr EnumName<AreaLights> enum_names<AreaLights>[] = {
    {AreaLights::ltc, "ltc"}, {AreaLights::representative, "representative"}};

// device: 8-bit texels, decoded and filtered by the device. exact: decoded on the CPU to 16-bit and float
// texels. packed: as device, but opaque surfaces have roughness in the normal map's alpha and metallic in
// base colour's.
enum class TexturePrecision { device, exact, packed };
template <>
inline constexpr EnumName<TexturePrecision> enum_names<TexturePrecision>[] = {
    {TexturePrecision::device, "device"},
    {TexturePrecision::exact, "exact"},
    {TexturePrecision::packed, "packed"}};

// Order of blended surfaces. sorted: draws far to near. unsorted: scene order. triangles: all triangles
// far to near. Order-independent: weighted, by depth; moments, by transmittance in front. list: sorted per
// fragment. off: not drawn.
enum class Transparency { sorted, unsorted, triangles, weighted, moments, list, off };
template <>
inline constexpr EnumName<Transparency> enum_names<Transparency>[] = {{Transparency::sorted, "sorted"},
                                                                      {Transparency::unsorted, "unsorted"},
                                                                      {Transparency::triangles, "triangles"},
                                                                      {Transparency::weighted, "weighted"},
                                                                      {Transparency::moments, "moments"},
                                                                      {Transparency::list, "list"},
                                                                      {Transparency::off, "off"}};

// Where skinned and morphed vertices are deformed: once per frame in compute, or in the vertex shader of
// every draw.
enum class Skinning { compute, vertex };
template <>
inline constexpr EnumName<Skinning> enum_names<Skinning>[] = {{Skinning::compute, "compute"},
                                                              {Skinning::vertex, "vertex"}};

// Transform of a skinned normal: the mean of the joints' inverse transposes, or the inverse transpose of
// the mean of their matrices. glTF does not specify it. Both agree for a vertex with one joint.
enum class SkinNormals { joints, blended };
template <>
inline constexpr EnumName<SkinNormals> enum_names<SkinNormals>[] = {{SkinNormals::joints, "joints"},
                                                                    {SkinNormals::blended, "blended"}};

enum class SpecularAlbedo { table, fit };
template <>
inline constexpr EnumName<SpecularAlbedo> enum_names<SpecularAlbedo>[] = {{SpecularAlbedo::table, "table"},
                                                                          {SpecularAlbedo::fit, "fit"}};

// Light that reaches a dielectric's base below a coloured layer: 1 minus the largest component of F, or 1
// minus each component. glTF 2.0, appendix B, leaves this to implementations; the first preserves the
// base's hue.
enum class BaseLayer { max, component };
template <>
inline constexpr EnumName<BaseLayer> enum_names<BaseLayer>[] = {{BaseLayer::max, "max"},
                                                                {BaseLayer::component, "component"}};

// Falloff of a spot from the inner to the outer angle, by t linear in the cosine, 1 at the inner angle:
// t^2 (KHR_lights_punctual), or t^2 (3 - 2 t).
enum class SpotFalloff { gltf, smoothstep };
template <>
inline constexpr EnumName<SpotFalloff> enum_names<SpotFalloff>[] = {{SpotFalloff::gltf, "gltf"},
                                                                    {SpotFalloff::smoothstep, "smoothstep"}};

// Factor on a light's intensity at distance d: 1 - (d / range)^4 (KHR_lights_punctual), or its square
// (Karis 2013, "Real Shading in Unreal Engine 4").
enum class RangeWindow { gltf, squared };
template <>
inline constexpr EnumName<RangeWindow> enum_names<RangeWindow>[] = {{RangeWindow::gltf, "gltf"},
                                                                    {RangeWindow::squared, "squared"}};

enum class Multiscatter { off, energy, fdez, walk };
template <>
inline constexpr EnumName<Multiscatter> enum_names<Multiscatter>[] = {{Multiscatter::off, "off"},
                                                                      {Multiscatter::energy, "energy"},
                                                                      {Multiscatter::fdez, "fdez"},
                                                                      {Multiscatter::walk, "walk"}};

// Storage of the scene's depth. d32f: reversed, 1 at the near plane, which suits the precision of floats.
// d32f_standard: 0 at the near plane. d24, d16: reversed integers, whose precision does not depend on the
// direction.
enum class DepthFormat { d32f, d32f_standard, d24, d16 };
template <>
inline constexpr EnumName<DepthFormat> enum_names<DepthFormat>[] = {
    {DepthFormat::d32f, "d32f"},
    {DepthFormat::d32f_standard, "d32f-standard"},
    {DepthFormat::d24, "d24"},
    {DepthFormat::d16, "d16"}};

enum class LitFormat { fp32, fp16, b10g11r11 };
template <>
inline constexpr EnumName<LitFormat> enum_names<LitFormat>[] = {
    {LitFormat::fp32, "fp32"}, {LitFormat::fp16, "fp16"}, {LitFormat::b10g11r11, "b10g11r11"}};

// Shading of the deferred path's G-buffer: by a full-screen triangle, or in compute.
enum class Lighting { fragment, compute };
template <>
inline constexpr EnumName<Lighting> enum_names<Lighting>[] = {{Lighting::fragment, "fragment"},
                                                              {Lighting::compute, "compute"}};

// How the deferred path draws materials with layers: into the G-buffer, or by the forward shader after
// deferred lighting.
enum class Layers { gbuffer, forward };
template <>
inline constexpr EnumName<Layers> enum_names<Layers>[] = {{Layers::gbuffer, "gbuffer"},
                                                          {Layers::forward, "forward"}};

enum class ShadingPrecision { fp32, fp16 };
template <>
inline constexpr EnumName<ShadingPrecision> enum_names<ShadingPrecision>[] = {
    {ShadingPrecision::fp32, "fp32"}, {ShadingPrecision::fp16, "fp16"}};

// Specular light of an environment.
enum class Ibl { split, sampled };
template <>
inline constexpr EnumName<Ibl> enum_names<Ibl>[] = {{Ibl::split, "split"}, {Ibl::sampled, "sampled"}};

enum class IblDiffuse { sh, sh_windowed, map };
template <>
inline constexpr EnumName<IblDiffuse> enum_names<IblDiffuse>[] = {
    {IblDiffuse::sh, "sh"}, {IblDiffuse::sh_windowed, "sh-windowed"}, {IblDiffuse::map, "map"}};

enum class Shadows { off, pcf, evsm, evsm4, msm4, pcss, clipmap };
template <>
inline constexpr EnumName<Shadows> enum_names<Shadows>[] = {
    {Shadows::off, "off"},   {Shadows::pcf, "pcf"},   {Shadows::evsm, "evsm"},      {Shadows::evsm4, "evsm4"},
    {Shadows::msm4, "msm4"}, {Shadows::pcss, "pcss"}, {Shadows::clipmap, "clipmap"}};

enum class ShadowFit { view, depth };
template <>
inline constexpr EnumName<ShadowFit> enum_names<ShadowFit>[] = {{ShadowFit::view, "view"},
                                                                {ShadowFit::depth, "depth"}};

enum class ShadowCasters { needed, all };
template <>
inline constexpr EnumName<ShadowCasters> enum_names<ShadowCasters>[] = {{ShadowCasters::needed, "needed"},
                                                                        {ShadowCasters::all, "all"}};

enum class EvsmPrecision { automatic, fp32, fp16 };
template <>
inline constexpr EnumName<EvsmPrecision> enum_names<EvsmPrecision>[] = {
    {EvsmPrecision::automatic, "auto"}, {EvsmPrecision::fp32, "fp32"}, {EvsmPrecision::fp16, "fp16"}};

enum class EvsmDepth { from_zero, from_minus_one };
template <>
inline constexpr EnumName<EvsmDepth> enum_names<EvsmDepth>[] = {{EvsmDepth::from_zero, "0..1"},
                                                                {EvsmDepth::from_minus_one, "-1..1"}};

// Shading rate of a fragment with MSAA: once for all covered samples, or for each.
enum class MsaaShading { pixel, sample };
template <>
inline constexpr EnumName<MsaaShading> enum_names<MsaaShading>[] = {{MsaaShading::pixel, "pixel"},
                                                                    {MsaaShading::sample, "sample"}};

// Samples of a pixel that deferred lighting shades separately: all; samples with different G-buffer bits;
// samples that differ visibly; samples of pixels that no triangle covers completely.
enum class MsaaEdges { all, exact, similar, coverage };
template <>
inline constexpr EnumName<MsaaEdges> enum_names<MsaaEdges>[] = {{MsaaEdges::all, "all"},
                                                                {MsaaEdges::exact, "exact"},
                                                                {MsaaEdges::similar, "similar"},
                                                                {MsaaEdges::coverage, "coverage"}};

// Mean of a pixel's samples: of their radiance, or weighted by a tone curve.
enum class Resolve { linear, tonemapped };
template <>
inline constexpr EnumName<Resolve> enum_names<Resolve>[] = {{Resolve::linear, "linear"},
                                                            {Resolve::tonemapped, "tonemapped"}};

// Normal whose screen-space variation specular antialiasing filters: the interpolated normal, or the
// normal-mapped one.
enum class SpecularNormals { geometry, mapped };
template <>
inline constexpr EnumName<SpecularNormals> enum_names<SpecularNormals>[] = {
    {SpecularNormals::geometry, "geometry"}, {SpecularNormals::mapped, "mapped"}};

// How roughness grows with this variation: alpha^2 by its variance within a pixel (Tokuyoshi and Kaplanyan
// 2019), or perceptual roughness by its largest component, as in three.js.
enum class SpecularKernel { variance, slope };
template <>
inline constexpr EnumName<SpecularKernel> enum_names<SpecularKernel>[] = {
    {SpecularKernel::variance, "variance"}, {SpecularKernel::slope, "slope"}};

enum class ReferenceMode { surface, scene };
template <>
inline constexpr EnumName<ReferenceMode> enum_names<ReferenceMode>[] = {{ReferenceMode::surface, "surface"},
                                                                        {ReferenceMode::scene, "scene"}};

struct Size {
    int width = 640, height = 360;  // pixels
    bool operator==(const Size&) const = default;
};

struct Rgb {
    float r = 0, g = 0, b = 0;
    bool operator==(const Rgb&) const = default;
};

}  // namespace diptych
