// SPDX-License-Identifier: MIT
// Everything that may change a pixel of a Frame. A Setting is a member of Settings and a row of
// setting_rows.h, and the row holds every fact about it: the command line, JSON, what can be rendered,
// what a path ignores, what a sweep tries and what the reference follows are read from there.
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
    DepthFormat depth_format = DepthFormat::d32f;
    LitFormat lit_format = LitFormat::fp32;
    ShadingPrecision shading_precision = ShadingPrecision::fp32;
    Size size;
    std::string camera;  // "" the first; an index, a name, or "eye=x,y,z target=x,y,z fov=deg near=m far=m"
    double time = 0.0;   // s
    std::string animation;  // "" all of them; an index or a name
    Skinning skinning = Skinning::compute;
    SkinNormals skin_normals = SkinNormals::joints;
    std::string env = "none";   // file of a lat-long environment, or scene
    float env_rotation = 0.0f;  // degrees about +Y
    bool env_sun = false;
    float ibl_intensity = 1.0f;
    Ibl ibl = Ibl::split;
    IblDiffuse ibl_diffuse = IblDiffuse::sh;
    int ibl_samples = 256;
    float ibl_bias = 0.0f;     // mip levels
    Rgb ambient;               // W/(sr m^2)
    bool scene_lights = true;  // the scene's own lights
    std::string lights;        // "" none, "point:64,spot:16", or a file's name
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
    float shadow_distance = 0.0f;  // m; 0: as far as the scene reaches
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
    float spec_aa_variance = 0.15915494f;  // square pixels
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

    // One value from the words of the command line, e.g. set("size", "640x360"). Throws std::runtime_error
    // naming option, value and what is accepted. "off" and "none" both call off whatever can be.
    void set(std::string_view option, const std::string& value);
    // The way back: the words that set() understands. Throws std::runtime_error of an unknown option.
    std::string valueOf(std::string_view option) const;

    // Why this combination has no meaning or is not built yet, naming the option and its value;
    // nothing where it can be rendered.
    std::optional<std::string> problem() const;

    // Calls visit(Field, pointer to member) for every row, in the order of the members. In setting_rows.h.
    template <class Visit>
    static void rows(Visit&& visit);
    // Calls visit(Field, member) for every member of `self`, which may be const, in the same order.
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit);
};

// By path, why a Setting changes no bit of what the path draws; empty where the path reads it.
struct IgnoredBecause {
    std::string_view deferred = {};
    std::string_view forward_plus = {};
    std::string_view reference = {};
    bool (*unless)(const Settings&) = nullptr;  // what makes their path read it after all

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

// Which values mean something at all. Where there is no check, all that the type can hold do.
struct ValidValues {
    std::string_view are = {};  // "is at least 0"
    bool (*check)(const Settings&) = nullptr;
};

// Why no value but the default can be rendered; empty where every one can.
struct DefaultOnly {
    std::string_view because = {};              // "has no effect without --haze on"
    bool (*unless)(const Settings&) = nullptr;  // what lifts it; nullptr: nothing
};

// All facts about one Setting. Values stand in the words of Settings::set().
struct Field {
    std::string_view option;  // "--" + option on the command line; in JSON with _ for -
    std::string_view help;

    // What the words "off" and "none" set; nothing where it cannot be called off.
    std::optional<std::string_view> off = std::nullopt;
    ValidValues valid = {};
    DefaultOnly default_only = {};
    IgnoredBecause ignored = {};
    // What the reference takes every value for but what calls it off; empty: it tells them apart.
    std::string_view one_for_reference = {};

    // What a sweep of speed against accuracy tries: nothing (a scene's content, on which the reference
    // depends, is no such choice), "all" values of an enumeration or switch, or these, separated by commas;
    // of a size, parts of the given one.
    std::string_view sweep = {};
    // Whose swept values are combined with this one's, separated by commas, "*" for every other Setting.
    // All else is tried one at a time.
    std::string_view sweep_with = {};

    // The reference in mode surface shades what forward+ captures: what that capture is told in place of
    // what the reference is. Nothing: the same as the reference, and the default of what it alone reads.
    std::optional<std::string_view> for_surfaces = std::nullopt;
};

// Every row's Field, in order; and the one of an option, which throws std::runtime_error where there is none.
std::span<const Field> settingFields();
const Field& settingField(std::string_view option);

// What Settings::set() accepts in short: "deferred|forward_plus|reference", "WxH", "F". Throws
// std::runtime_error where there is no such option.
std::string acceptedValues(std::string_view option);

// Why the path of `settings` ignores an option of them, "deferred has no depth pre-pass"; empty where it
// reads it.
std::string_view ignoredBecause(const Settings& settings, std::string_view option);
// The same with what its path ignores at its default: equal where they are one picture.
Settings effectiveSettings(const Settings& settings);

// What the reference is told beside a path with these Settings: the effective ones of path = reference.
Settings referenceSettings(const Settings& settings);
// What a path is told beside the reference: the same without what the reference alone reads.
Settings withoutReference(const Settings& settings);
// The same with what the reference alone reads taken from `reference`.
Settings withReferenceOf(const Settings& settings, const Settings& reference);
// What forward+ is told to capture for the reference in mode surface: the surfaces that these Settings show,
// with nothing packed and nothing of what lights them that a capture does not need.
Settings surfaceSettings(const Settings& settings);

// Two Settings whose swept values are combined, `a` the slower; b is "*" for every other one.
struct SweepPair {
    std::string_view a, b;
};
std::vector<SweepPair> sweepPairs();

// The words of Field::sweep for Settings::set(), in order; of a size as parts of `given`'s. Empty: it is not
// swept. Throws std::runtime_error where there is no such option.
std::vector<std::string> sweptValues(const Settings& given, std::string_view option);
// "1/2" of a size is that part of `given`'s, each side rounded and at least 1; any other word stays.
std::string wordsFor(const Settings& given, std::string_view option, const std::string& word);

// Every setting by its option's name (- written _), as JSON text; and the way back: a key that is absent
// keeps the value of `base`, an unknown key or a value of the wrong kind throws std::runtime_error. The
// object may stand alone or in { "settings": ... }.
std::string toJson(const Settings& settings, int indent = 2);
Settings settingsFromJson(const std::string& text, const Settings& base = {});

}  // namespace diptych
