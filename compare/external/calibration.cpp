// SPDX-License-Identifier: MIT
#include "compare/external/calibration.h"

#include "compare/external/placement.h"
#include "compare/external/response.h"
#include "compare/external/sky.h"
#include "compare/render/reference_frame.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/srgb.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace diptych::external {
namespace {

constexpr double named_fov = 0.15;      // degrees
constexpr double named_aspect = 0.01;   // pixel aspect ratio minus 1
constexpr double named_shift = 0.2;     // pixels
constexpr double named_factor = 0.113;  // 12 %, natural logarithm
constexpr double named_dark = 0.02;     // fraction of the expected value; less means not lit

// The lamp type for a light type. Any other type counts as area.
Lamp lampOf(LightKind kind) {
    switch (kind) {
        case LightKind::directional:
            return Lamp::directional;
        case LightKind::point:
            return Lamp::point;
        case LightKind::spot:
            return Lamp::spot;
        default:
            return Lamp::area;
    }
}

// A well-known factor within 6 %, such as "pi", "1 / (4 pi)" or "2"; else the number itself.
struct NamedFactor {
    double value;
    const char* name;
};
NamedFactor namedFactor(double factor) {
    constexpr double pi = glm::pi<double>();
    constexpr std::array known{NamedFactor{pi, "pi"},       NamedFactor{1 / pi, "1 / pi"},
                               NamedFactor{2, "2"},         NamedFactor{0.5, "1 / 2"},
                               NamedFactor{4, "4"},         NamedFactor{0.25, "1 / 4"},
                               NamedFactor{4 * pi, "4 pi"}, NamedFactor{1 / (4 * pi), "1 / (4 pi)"},
                               NamedFactor{683, "683"},     NamedFactor{1.0 / 683, "1 / 683"}};
    for (const NamedFactor& one : known)
        if (std::abs(std::log(factor / one.value)) < 0.06) return one;
    return {factor, nullptr};
}
std::string describe(const NamedFactor& factor) {
    return factor.name ? factor.name : fmt::format("{:.3g}", factor.value);
}

double luminous(const glm::dvec3& radiance) {
    return (radiance.r + radiance.g + radiance.b) / 3;
}

class Calibration {
public:
    Calibration(const Scene& charts, std::span<const LampFrame> images) : charts_(charts) {
        for (const LampFrame& shown : images) images_[shown.lamp] = &shown;
        if (!images_.contains(Lamp::none) || images_.at(Lamp::none)->image.empty())
            throw std::invalid_argument("a calibration needs the picture without lamps");
    }

    std::vector<Deviation> find() {
        if (!checkPlacement()) return std::move(found_);
        findResponse();
        findTextures();
        findLamps();
        findSky();
        return std::move(found_);
    }

private:
    using Correction = nlohmann::ordered_json;

    void say(std::string name, std::string text, Correction correction = Correction::object()) {
        found_.push_back({std::move(name), std::move(text), std::move(correction)});
    }

    int idOf(const std::string& material) const {
        for (std::size_t i = 0; i < charts_.materials.size(); ++i)
            if (charts_.materials[i].name == material) return static_cast<int>(i);
        throw std::logic_error("no chart is called " + material);
    }
    std::vector<std::pair<int, double>> chartsCalled(const std::string& prefix) const {
        std::vector<std::pair<int, double>> all;
        for (std::size_t i = 0; i < charts_.materials.size(); ++i)
            if (const std::string& name = charts_.materials[i].name; name.starts_with(prefix))
                all.emplace_back(static_cast<int>(i), std::stod(name.substr(prefix.size())));
        return all;
    }

    // written(): pixel value of a chart; expected(): radiance.
    std::optional<glm::dvec3> written(Lamp lamp, const std::string& chart) const {
        const LampFrame& shown = *images_.at(lamp);
        if (shown.image.empty()) return {};
        return medianColor(shown.truth.ids, idOf(chart), shown.image, placement_);
    }
    std::optional<glm::dvec3> radiance(Lamp lamp, const std::string& chart) const {
        const std::optional<glm::dvec3> value = written(lamp, chart);
        return value ? std::optional(response_->radiance(*value)) : std::nullopt;
    }
    glm::dvec3 expected(Lamp lamp, const std::string& chart) const {
        const ChartReference& truth = images_.at(lamp)->truth;
        return medianColor(truth.ids, idOf(chart), truth.lit, Placement()).value_or(glm::dvec3(0));
    }

    bool checkPlacement() {
        const LampFrame& shown = *images_.at(Lamp::none);
        std::vector<int> marks;
        for (const auto& [id, number] : chartsCalled("mark ")) marks.push_back(id);
        const std::optional<Placement> found = findPlacement(shown.truth.ids, marks, shown.image);
        if (!found) {
            say("unrecognised",
                "the marks of the charts are not found: the renderer draws nothing, uses another view or "
                "ignores emission");
            return false;
        }
        placement_ = *found;
        if (found->upside_down) say("upside_down", "the picture is upside down", {{"upside_down", true}});
        if (found->mirrored) say("mirrored", "the picture is mirrored, left for right", {{"mirrored", true}});
        const double expected_fov = charts_.cameras.front().yfov;
        const double fov = 2 * std::atan(std::tan(expected_fov / 2) / found->scale.y);
        const double offset = glm::degrees(fov - expected_fov);
        if (std::abs(offset) > named_fov)
            say("fov",
                fmt::format("the field of view is {:.2f} degrees {} than requested", std::abs(offset),
                            offset > 0 ? "wider" : "narrower"),
                {{"fov_offset", std::round(-100 * offset) / 100}});
        const double aspect = found->scale.x / found->scale.y;
        if (std::abs(aspect - 1) > named_aspect)
            say("aspect", fmt::format("pixels are {:.3g} times as wide as high", aspect));
        if (std::abs(found->shift.x) > named_shift || std::abs(found->shift.y) > named_shift) {
            // Corrections apply to the projection, so a flip of the image reverses the shift.
            const auto correction = [](double shift, bool flipped) {
                return std::round(-100 * (flipped ? -shift : shift)) / 100;
            };
            Correction by = Correction::object();
            if (std::abs(found->shift.x) > named_shift)
                by["shift_x"] = correction(found->shift.x, found->mirrored);
            if (std::abs(found->shift.y) > named_shift)
                by["shift_y"] = correction(found->shift.y, found->upside_down);
            say("shift",
                fmt::format("the picture is {:.2f} pixels too far right and {:.2f} too far down",
                            found->shift.x, found->shift.y),
                std::move(by));
        }
        return true;
    }

    void findResponse() {
        std::vector<RampStep> ramp;
        for (const auto& [id, value] : chartsCalled("ramp ")) {
            const LampFrame& shown = *images_.at(Lamp::none);
            if (const auto here = medianColor(shown.truth.ids, id, shown.image, placement_))
                ramp.push_back({value, luminous(*here)});
        }
        response_.emplace(std::move(ramp));
        std::array<glm::dvec3, 3> columns{};
        constexpr std::array names{"red", "green", "blue"};
        for (std::size_t c = 0; c < 3; ++c)
            columns[c] = written(Lamp::none, names[c]).value_or(glm::dvec3(0));
        response_->measurePrimaries(columns, 0.5);
        if (response_->kind() == CurveKind::srgb)
            say("srgb_output",
                fmt::format("pixels are encoded as sRGB{}; they should be linear",
                            response_->cutOffAt() ? " and clipped at 1" : ""),
                {{"transfer", "srgb"}});
        if (response_->kind() == CurveKind::tone)
            say("tone_curve", "pixels have a tone curve; they should be linear");
        if (std::abs(std::log(response_->exposure())) > named_factor && response_->kind() != CurveKind::tone)
            say("exposure", fmt::format("all radiance is multiplied by {}",
                                        describe(namedFactor(response_->exposure()))));
        if (response_->cutOffAt() && response_->kind() == CurveKind::linear)
            say("cut_off", fmt::format("radiance is clipped at {:.3g}", *response_->cutOffAt()));
        if (!response_->primaries())
            say("primaries", "red, green and blue have unknown primaries");
        else if (*response_->primaries() == Primaries::display_p3)
            say("primaries", "red, green and blue have the primaries of Display P3",
                {{"primaries", "display_p3"}});
        else if (*response_->primaries() == Primaries::rec2020)
            say("primaries", "red, green and blue have the primaries of Rec.2020",
                {{"primaries", "rec2020"}});
    }

    void findTextures() {
        if (const auto shown = radiance(Lamp::none, "colour texture")) {
            const double code = 128.0 / 255;
            const std::array candidates{linearFromSrgb(code), code, linearFromSrgb(linearFromSrgb(code))};
            const std::size_t best = nearest(luminous(*shown), candidates);
            if (best == 1) say("colour_textures_linear", "colour textures are read as linear; they are sRGB");
            if (best == 2) say("colour_textures_twice", "colour textures are decoded from sRGB twice");
        }
        // Uses the first lamp that lights the neighbouring white face.
        for (const Lamp lamp : {Lamp::directional, Lamp::point, Lamp::spot}) {
            const auto white = radiance(lamp, "white"), data = radiance(lamp, "data texture");
            const double white_expected = luminous(expected(lamp, "white"));
            if (!white || !data || luminous(*white) < named_dark * white_expected) continue;
            // The metal's reflectance does not depend on how the texture is decoded.
            const double metallic = 128.0 / 255, other = linearFromSrgb(metallic);
            const double expected_ratio = luminous(expected(lamp, "data texture")) / white_expected;
            const double metal = (expected_ratio - (1 - metallic)) / metallic;
            // The ground truth includes the distance of near lamps for both faces.
            const std::array candidates{expected_ratio, 1 - other + other * metal};
            if (nearest(luminous(*data) / luminous(*white), candidates) == 1)
                say("data_textures_srgb", "data textures are decoded from sRGB; they are linear");
            break;
        }
    }

    template <std::size_t N>
    static std::size_t nearest(double value, const std::array<double, N>& candidates) {
        std::size_t best = 0;
        const auto far = [&](std::size_t i) {
            return std::abs(std::log(std::max(value, 1e-6) / candidates[i]));
        };
        for (std::size_t i = 1; i < N; ++i)
            if (far(i) < far(best)) best = i;
        return best;
    }

    // White face under a lamp: measured over expected radiance.
    std::optional<double> partOf(Lamp lamp) const {
        const auto shown = radiance(lamp, "white");
        return shown ? std::optional(luminous(*shown) / luminous(expected(lamp, "white"))) : std::nullopt;
    }

    void findLamps() {
        std::map<Lamp, double> factors;
        for (const Lamp lamp : {Lamp::directional, Lamp::point, Lamp::spot, Lamp::area}) {
            const std::optional<double> part = partOf(lamp);
            const LampFrame& shown = *images_.at(lamp);
            if (!part || *part < named_dark)
                say(fmt::format("no_{}_lights", nameOf(lamp)),
                    fmt::format("{} lights are not drawn{}", nameOf(lamp),
                                shown.problem.empty() ? "" : ": " + shown.problem));
            else
                factors[lamp] = *part;
        }
        if (factors.empty()) return;
        // A common factor of all supported lamps is a single convention.
        const double first = factors.begin()->second;
        const bool alike = factors.size() > 1 && std::ranges::all_of(factors, [&](const auto& of) {
                               return std::abs(std::log(of.second / first)) < named_factor;
                           });
        if (alike) {
            sayFactor("light", "lights", first);
            return;
        }
        for (const auto& [lamp, factor] : factors)
            sayFactor(std::string(nameOf(lamp)), fmt::format("{} lights", nameOf(lamp)), factor);
    }

    void sayFactor(const std::string& name, const std::string& what, double factor) {
        if (!(std::abs(std::log(factor)) > named_factor)) return;
        const NamedFactor named = namedFactor(factor);
        say(name + "_factor", fmt::format("{} are {} times as bright as requested", what, describe(named)),
            {{name + "_factor", 1 / named.value}});
    }

    void findSky() {
        constexpr Lamp lamp = Lamp::environment;
        std::vector<TiltedFace> faces;
        double expected_all = 0, actual_all = 0;
        for (const std::string name : {"front", "left", "right", "up", "down"}) {
            const auto shown = radiance(lamp, name);
            if (!shown) continue;
            faces.push_back({normalOf(name), *shown});
            expected_all += luminous(lightFrom(charts_.environment->radiance, normalOf(name), false));
            actual_all += luminous(*shown);
        }
        const LampFrame& shown = *images_.at(lamp);
        if (faces.empty() || actual_all < named_dark * expected_all)
            return say("no_environment", fmt::format("the environment gives no light{}",
                                                     shown.problem.empty() ? "" : ": " + shown.problem));
        const SkyInterpretation sky = skyInterpretation(charts_.environment->radiance, faces);
        if (sky.mirrored)
            say("environment_mirrored", "the environment is mirrored, left for right",
                {{"environment_mirrored", true}});
        if (sky.rotation != 0)
            say("environment_rotation",
                fmt::format("the environment is rotated by {:g} degrees more than requested", sky.rotation),
                {{"environment_rotation", -sky.rotation}});
        if (sky.cut_off) say("ldr_environment", "the environment's radiance is clipped at 1");
        sayFactor("environment", "environments", sky.factor);
    }

    glm::dvec3 normalOf(const std::string& chart) const {
        const int id = idOf(chart);
        for (const Mesh& mesh : charts_.meshes)
            for (const Primitive& primitive : mesh.primitives)
                if (primitive.material == id) return glm::dvec3(primitive.normals.front());
        throw std::logic_error("no face is of " + chart);
    }

    const Scene& charts_;
    std::map<Lamp, const LampFrame*> images_;
    Placement placement_;
    std::optional<Response> response_;
    std::vector<Deviation> found_;
};

}  // namespace

std::string_view nameOf(Lamp lamp) {
    constexpr std::string_view names[] = {"no light", "directional", "point", "spot", "area", "environment"};
    return names[static_cast<std::size_t>(lamp)];
}

Scene chartsUnder(const Scene& charts, Lamp lamp) {
    Scene scene = charts;
    std::erase_if(scene.lights, [lamp](const Light& light) { return lampOf(light.kind) != lamp; });
    if (lamp != Lamp::environment) scene.environment.reset();
    if (lamp == Lamp::environment) scene.lights.clear();
    return scene;
}

Settings chartSettings(Lamp lamp) {
    Settings settings;
    settings.size = {384, 216};
    settings.shadows = Shadows::off;
    settings.scene_lights = lamp != Lamp::none;  // otherwise a scene without lights gets a default sun
    return settings;
}

ChartReference referenceUnder(const Scene& charts, Lamp lamp) {
    Settings settings = chartSettings(lamp);
    settings.reference_mode = ReferenceMode::scene;
    RenderOptions options;
    options.channels = {Channel::lit, Channel::material_id};
    options.runs = 0;
    // lightFrom() gives the exact irradiance of faces; rendering the sky takes seconds.
    const Scene scene = chartsUnder(charts, lamp == Lamp::environment ? Lamp::none : lamp);
    settings.scene_lights = lamp != Lamp::environment && settings.scene_lights;
    Frame frame = std::move(drawWithoutDevice(scene, {referenceSettings(settings)}, options).front());
    return {std::move(frame.channels.at(Channel::lit)), std::move(frame.channels.at(Channel::material_id))};
}

std::vector<Deviation> deviationsOf(const Scene& charts, std::span<const LampFrame> images) {
    return Calibration(charts, images).find();
}

}  // namespace diptych::external
