// SPDX-License-Identifier: MIT
// Everything that may change a pixel of a Frame. A Setting is a member of Settings and a row of
// setting_rows.h. The row has every property of it, for the command line, JSON, validity checks, ignored
// settings, sweeps and the reference.
#pragma once

#include "shared/frame/setting_values.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

struct Settings {
    Path path = Path::forward_plus;
    Assignment assign = Assignment::clustered;
    LightKernel light_kernel = LightKernel::automatic;
    Switch prepass = Switch::automatic;
    bool cull = true;
    GBufferEncoding gbuffer = GBufferEncoding::standard;
    Lighting lighting = Lighting::fragment;
    Layers layers = Layers::gbuffer;
    DepthFormat depth_format = DepthFormat::d32f;
    LitFormat lit_format = LitFormat::fp32;
    ShadingPrecision shading_precision = ShadingPrecision::fp32;
    Size size;
    std::string camera;     // "": the first; an index, a name, or "eye=x,y,z target=x,y,z fov=deg near=m
                            // far=m"
    double time = 0.0;      // s
    std::string animation;  // "": all; an index or a name
    std::string variant;    // "": primitives' own materials; an index or a name
    Skinning skinning = Skinning::compute;
    SkinNormals skin_normals = SkinNormals::joints;
    std::string env = "none";   // file name of a lat-long environment, or scene
    float env_rotation = 0.0f;  // degrees about +Y
    bool env_sun = false;
    float ibl_intensity = 1.0f;
    Ibl ibl = Ibl::split;
    IblDiffuse ibl_diffuse = IblDiffuse::sh;
    int ibl_samples = 256;
    float ibl_bias = 0.0f;  // mip levels
    Rgb ambient;            // W/(sr m^2)
    bool scene_lights = true;
    std::string lights;  // "": none; "point:64,spot:16", or a file name
    std::uint32_t seed = 0;
    float light_cutoff = 0.0f;  // W/(sr m^2)
    int pixel_lights = 4;
    AreaLights area_lights = AreaLights::ltc;
    TexturePrecision textures = TexturePrecision::device;
    SpecularAlbedo specular_albedo = SpecularAlbedo::table;
    Multiscatter multiscatter = Multiscatter::off;
    BaseLayer base_layer = BaseLayer::max;
    SpotFalloff spot_cone = SpotFalloff::gltf;
    RangeWindow range_window = RangeWindow::gltf;
    Shadows shadows = Shadows::pcf;
    int shadow_lights = 0;
    int shadow_size = 2048;  // texels
    int shadow_cascades = 4;
    int shadow_kernel = 3;  // texels
    ShadowFit shadow_fit = ShadowFit::view;
    float shadow_distance = 0.0f;  // m; 0: the scene's extent
    float shadow_bias = 0.5f;      // texels
    ShadowCasters shadow_casters = ShadowCasters::needed;
    int clipmap_pages = 512;
    int clipmap_page_size = 128;  // texels
    EvsmPrecision evsm_precision = EvsmPrecision::automatic;
    float evsm_exponent = 0.0f;           // 0: by precision
    float evsm_negative_exponent = 0.0f;  // 0: 5
    EvsmDepth evsm_depth = EvsmDepth::from_minus_one;
    float evsm_bleed = 0.0f;
    float evsm_min_variance = 1e-8f;
    int msaa = 1;
    MsaaShading msaa_shading = MsaaShading::pixel;
    MsaaEdges msaa_edges = MsaaEdges::exact;
    Resolve resolve = Resolve::linear;
    bool alpha_to_coverage = false;
    bool spec_aa = false;
    float spec_aa_variance = 0.15915494f;  // pixels squared
    float spec_aa_limit = 0.18f;
    SpecularNormals spec_aa_normals = SpecularNormals::geometry;
    SpecularKernel spec_aa_kernel = SpecularKernel::variance;
    Transparency transparency = Transparency::sorted;
    int transparency_layers = 8;
    bool haze = false;
    float haze_density = 1.0f;
    Rgb haze_rayleigh{5.8e-6f, 13.5e-6f, 33.1e-6f};  // 1/m at height 0
    float haze_rayleigh_height = 8000.0f;            // m
    Rgb haze_mie{2e-5f, 2e-5f, 2e-5f};               // 1/m at height 0
    float haze_mie_height = 1200.0f;                 // m
    float haze_g = 0.76f;
    float haze_ground = 0.0f;  // m, world y
    int haze_march_steps = 0;  // 0: closed form
    int spp = 1;
    ReferenceMode reference_mode = ReferenceMode::surface;

    bool operator==(const Settings&) const = default;

    // Sets one value from command line text, e.g. set("size", "640x360"). Throws std::runtime_error with
    // option, value and accepted values. "off" and "none" both switch off whatever can be.
    void set(std::string_view option, const std::string& value);
    // Inverse of set(). Throws std::runtime_error for an unknown option.
    std::string valueOf(std::string_view option) const;

    // Why this combination is invalid or not supported, with the option and its value; nothing if it can
    // be rendered.
    std::optional<std::string> problem() const;
    // The same of each value alone: what no other value can mend.
    std::optional<std::string> valueProblem() const;

    // Calls visit(Field, pointer to member) for every row, in member order. In setting_rows.h.
    template <class Visit>
    static void rows(Visit&& visit);
    // Calls visit(Field, member) for every member of `self`, which may be const, in member order.
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit);
};

// Why a Setting does not affect the image of a path; empty if the path reads it.
struct IgnoredBecause {
    std::string_view deferred = {};
    std::string_view forward_plus = {};
    std::string_view reference = {};
    bool (*unless)(const Settings&) = nullptr;  // condition under which the path reads it nevertheless

    constexpr std::string_view of(Path path) const {
        switch (path) {
            case Path::deferred:
                return deferred;
            case Path::forward_plus:
                return forward_plus;
            case Path::reference:
                return reference;
        }
        return {};
    }
};

// Range check of a value; without a check, every value of the type is valid.
struct ValidValues {
    std::string_view are = {};  // "is at least 0"
    bool (*check)(const Settings&) = nullptr;
};

// Why only the default can be rendered; empty if every value can.
struct DefaultOnly {
    std::string_view because = {};              // "has no effect without --haze on"
    bool (*unless)(const Settings&) = nullptr;  // condition that removes the restriction; nullptr: none
};

// All properties of one Setting. Values are text for Settings::set().
struct Field {
    std::string_view option;  // "--" + option on the command line; in JSON with _ instead of -
    std::string_view help;

    // Value set by "off" and "none"; nothing if it cannot be switched off.
    std::optional<std::string_view> off = std::nullopt;
    ValidValues valid = {};
    DefaultOnly default_only = {};
    IgnoredBecause ignored = {};
    // Value that the reference uses for all values except `off`; empty: it distinguishes them.
    std::string_view one_for_reference = {};

    // Values in a sweep of speed against accuracy: "all" of an enumeration or switch, or a comma-separated
    // list; for sizes, fractions of the requested size. Empty for scene content, which the reference depends
    // on.
    std::string_view sweep = {};
    // Settings whose swept values are combined with this one's, comma-separated; "*": every other Setting.
    // All others are varied one at a time.
    std::string_view sweep_with = {};

    // With --reference-mode surface the reference shades surfaces captured by forward+. This is the value
    // for that capture. Nothing: the reference's value, or the default for settings that only the
    // reference reads.
    std::optional<std::string_view> for_surfaces = std::nullopt;
};

// Fields of all rows in order, and the Field of one option; the latter throws std::runtime_error if
// unknown.
std::span<const Field> settingFields();
const Field& settingField(std::string_view option);

// Short text of the values that Settings::set() accepts: "deferred|forward_plus|reference", "WxH", "F".
// Throws std::runtime_error for an unknown option.
std::string acceptedValues(std::string_view option);

// Why the path of `settings` ignores an option, e.g. "deferred has no depth pre-pass"; empty if it reads
// it.
std::string_view ignoredBecause(const Settings& settings, std::string_view option);
// The same with ignored settings at their defaults. Equal effective settings give the same image.
Settings effectiveSettings(const Settings& settings);

// Settings of the reference for a path's Settings: effective settings with path = reference.
Settings referenceSettings(const Settings& settings);
// The same with settings that only the reference reads at their defaults.
Settings withoutReference(const Settings& settings);
// The same with settings that only the reference reads taken from `reference`.
Settings withReferenceOf(const Settings& settings, const Settings& reference);
// Settings of the forward+ capture for --reference-mode surface: the same surfaces, without quantization
// and without lighting that a capture does not need.
Settings surfaceSettings(const Settings& settings);

// Two Settings whose swept values are combined, with `a` in the outer loop; b is "*" for every other
// Setting.
struct SweepPair {
    std::string_view a, b;
};
std::vector<SweepPair> sweepPairs();

// Values of Field::sweep for Settings::set(), in order; sizes as fractions of `requested`. Empty if not
// swept. Throws std::runtime_error for an unknown option.
std::vector<std::string> sweptValues(const Settings& requested, std::string_view option);
// Converts a fraction such as "1/2" to a size relative to `requested`, rounded and at least 1; returns other
// words unchanged.
std::string wordsFor(const Settings& requested, std::string_view option, const std::string& word);

// All settings as JSON, by option name with _ instead of -; and its inverse. A missing key keeps the value
// of `base`. An unknown key or a value of the wrong type throws std::runtime_error. The text may be the
// object itself or { "settings": ... }.
std::string toJson(const Settings& settings, int indent = 2);
Settings settingsFromJson(const std::string& text, const Settings& base = {});

}  // namespace diptych
