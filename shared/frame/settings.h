// SPDX-License-Identifier: MIT
// Everything that may change a pixel of a Frame, described once: the command line, the JSON that every
// report prints, equality and sweeps all walk Settings::fields().
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

enum class Path { deferred, forward_plus, reference };
enum class Assignment { every, tiled, clustered, per_object };
enum class LightKernel { automatic, scatter, gather };
enum class Switch { automatic, on, off };
enum class GBufferEncoding { compact, standard, full };
enum class AreaLights { ltc, representative };
enum class Shadows { off, pcf, evsm, clipmap };
enum class EvsmPrecision { automatic, fp32, fp16 };
enum class ReferenceMode { surface, scene };

struct Size {
    int width = 640, height = 360;
    bool operator==(const Size&) const = default;
};

struct Rgb {
    float r = 0, g = 0, b = 0;
    bool operator==(const Rgb&) const = default;
};

struct Settings {
    Path path = Path::forward_plus;
    Assignment assign = Assignment::clustered;
    LightKernel light_kernel = LightKernel::automatic;
    Switch prepass = Switch::automatic;
    GBufferEncoding gbuffer = GBufferEncoding::standard;
    Size size;
    std::string camera;  // "" the first; an index, a name, or "eye=x,y,z target=x,y,z fov=deg near=m far=m"
    double time = 0.0;   // s
    std::string env = "none";  // file of a lat-long environment
    float ibl_intensity = 1.0f;
    Rgb ambient;         // W/(sr m^2)
    std::string lights;  // "" none, "point:64,spot:16", or a file's name
    std::uint32_t seed = 0;
    float light_cutoff = 0.0f;  // W/(sr m^2)
    int pixel_lights = 4;
    AreaLights area_lights = AreaLights::ltc;
    Shadows shadows = Shadows::off;
    int shadow_lights = 0;
    EvsmPrecision evsm_precision = EvsmPrecision::automatic;
    float evsm_exponent = 40.0f;
    float evsm_bleed = 0.0f;
    float evsm_min_variance = 0.0f;
    int msaa = 1;
    bool sort = true;
    bool haze = false;
    int spp = 1;
    ReferenceMode reference_mode = ReferenceMode::surface;

    bool operator==(const Settings&) const = default;

    // Calls visit(Field, member) for every member, in the order above. `self` may be const.
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit);

    // Why this combination has no meaning or is not built yet, naming the option and its value;
    // nothing where it can be rendered.
    std::optional<std::string> problem() const;
};

// How a setting is called on the command line ("--" + option, in JSON with _ for -) and what it does.
// What a sweep of speed against accuracy tries of it: nothing (a scene's content, which the truth depends on,
// is no such choice), "all" values of an enumeration or switch, or these words for set(), separated by
// commas; of a size, parts of the given one.
struct Field {
    std::string_view option;
    std::string_view help;
    std::string_view sweep = {};
};

template <class Self, class Visit>
void Settings::fields(Self& s, Visit&& visit) {
    visit(Field{"path", "deferred, forward_plus or reference", "all"}, s.path);
    visit(Field{"assign", "how lights are chosen for a pixel", "all"}, s.assign);
    visit(Field{"light-kernel", "how lists are filled: by a thread a light, or a workgroup a cell",
                "scatter,gather"},
          s.light_kernel);
    visit(Field{"prepass", "depth pre-pass of the forward+ path", "on,off"}, s.prepass);
    visit(Field{"gbuffer", "encoding of the deferred path's G-buffer", "all"}, s.gbuffer);
    visit(Field{"size", "picture size, WxH", "1/4,1/2,3/4"}, s.size);
    visit(Field{"camera", "index, name, or \"eye=x,y,z target=x,y,z fov=deg near=m far=m\""}, s.camera);
    visit(Field{"time", "animation time, seconds"}, s.time);
    visit(Field{"env", "lat-long environment, .exr or .hdr, or none"}, s.env);
    visit(Field{"ibl-intensity", "factor on the environment's radiance"}, s.ibl_intensity);
    visit(Field{"ambient", "constant ambient radiance R,G,B"}, s.ambient);
    visit(Field{"lights", "KIND:N[,KIND:N...] for a seeded rig, or a JSON file of lights"}, s.lights);
    visit(Field{"seed", "seed of the light rig"}, s.seed);
    visit(Field{"light-cutoff", "luminance of a white surface where a light without a range ends; 0: nowhere",
                "0,1e-4,1e-3,1e-2"},
          s.light_cutoff);
    visit(Field{"pixel-lights", "lights shaded per pixel with --assign per_object", "0,1,2,4,8"},
          s.pixel_lights);
    visit(Field{"area-lights", "how area lights are evaluated", "all"}, s.area_lights);
    visit(Field{"shadows", "shadow technique", "all"}, s.shadows);
    visit(Field{"shadow-lights", "local lights that cast shadows", "0,1,4"}, s.shadow_lights);
    visit(Field{"evsm-precision", "moments' format", "fp32,fp16"}, s.evsm_precision);
    visit(Field{"evsm-exponent", "warp exponent", "5,10,20,40"}, s.evsm_exponent);
    visit(Field{"evsm-bleed", "light-bleeding reduction, 0 to 1", "0,0.2,0.5"}, s.evsm_bleed);
    visit(Field{"evsm-min-variance", "smallest variance", "0,1e-6,1e-4"}, s.evsm_min_variance);
    visit(Field{"msaa", "samples per pixel, 1 or 4", "1,4"}, s.msaa);
    visit(Field{"sort", "sort transparent draws", "all"}, s.sort);
    visit(Field{"haze", "participating medium"}, s.haze);
    visit(Field{"spp", "samples per pixel of the reference"}, s.spp);
    visit(Field{"reference-mode", "what the reference shades"}, s.reference_mode);
}

// Two Settings whose swept values are crossed; all others are tried one at a time. "*": every other one.
struct SweepPair {
    std::string_view a, b;
};
inline constexpr SweepPair sweepPairs[] = {
    {"path", "*"},
    {"gbuffer", "size"},
    {"msaa", "gbuffer"},
    {"msaa", "size"},
    {"assign", "light-cutoff"},
    {"assign", "pixel-lights"},
    {"shadows", "shadow-lights"},
    {"shadows", "evsm-precision"},
    {"shadows", "evsm-exponent"},
    {"shadows", "evsm-bleed"},
    {"shadows", "evsm-min-variance"},
};

// The words of Field::sweep for set(), in order; of a size as parts of `given`'s. Empty: it is not swept.
std::vector<std::string> sweptValues(const Settings& given, std::string_view option);
// "1/2" of a size is that part of `given`'s, each side rounded and at least 1; any other word stays.
std::string wordsFor(const Settings& given, std::string_view option, const std::string& word);

// Why a path does not read a Setting, "deferred has no depth pre-pass"; empty where it does.
std::string_view unreadBecause(Path path, std::string_view option);
// The same with what its path does not read at its usual value: equal where they are one picture.
Settings readSettings(const Settings& settings);

// The values of an enumeration by name, in order: "automatic" is written auto.
template <class E>
const std::vector<std::pair<E, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<Path, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<Assignment, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<LightKernel, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<Switch, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<GBufferEncoding, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<AreaLights, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<Shadows, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<EvsmPrecision, std::string_view>>& enumNames();
template <>
const std::vector<std::pair<ReferenceMode, std::string_view>>& enumNames();

template <class E>
std::string_view nameOf(E value) {
    for (const auto& [candidate, name] : enumNames<E>())
        if (candidate == value) return name;
    return "?";
}

// Every setting by its option's name (- written _), as JSON text; and the way back: a key that is absent
// keeps the value of `base`, an unknown key or a value of the wrong kind throws std::runtime_error. The
// object may stand alone or in { "settings": ... }.
std::string toJson(const Settings& settings, int indent = 2);
Settings settingsFromJson(const std::string& text, const Settings& base = {});

// One value from the words of the command line, e.g. set(s, "size", "640x360"). Throws
// std::runtime_error naming option, value and what is accepted. Here and in JSON "off" and "none" both call
// off whatever can be.
void set(Settings& settings, std::string_view option, const std::string& value);

// The way back, and what set() accepts in short: "deferred|forward_plus|reference", "WxH", "F". Both throw
// std::runtime_error where there is no such option.
std::string valueOf(const Settings& settings, std::string_view option);
std::string acceptedValues(std::string_view option);

}  // namespace diptych
