// SPDX-License-Identifier: MIT
#include "tests/image/injected_faults.h"
#include "tests/support/srgb.h"

#include "compare/explain/lighting_components.h"
#include "shared/contract/debug_mode.h"
#include "shared/scene/lights/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace diptych::tests {
namespace {

using OfValue = std::function<double(double)>;

std::function<void(float*)> each(const OfValue& of, int components = 3) {
    return [of, components](float* p) {
        for (int c = 0; c < components; ++c) p[c] = static_cast<float>(of(double{p[c]}));
    };
}

void normalize(float* p) {
    const double length = std::sqrt(double{p[0]} * p[0] + double{p[1]} * p[1] + double{p[2]} * p[2]);
    for (int c = 0; c < 3 && length > 0; ++c) p[c] = static_cast<float>(p[c] / length);
}

float* dataOf(Frame& frame, Channel mode) {
    return frame.channels.at(mode).data.data();
}

// Changes terms, and lit accordingly.
using OfTerm = std::function<float(float term, std::size_t pixel)>;
std::function<void(InjectedView&, Frame&)> term(std::vector<Channel> terms, const OfTerm& of) {
    return [terms, of](InjectedView& view, Frame& frame) {
        const Image before = sumOfTerms(frame);
        for (const Channel mode : terms) {
            Image& image = frame.channels.at(mode);
            for (std::size_t i = 0; i < image.data.size(); ++i)
                if (view.covered(i / 3)) image.data[i] = of(image.data[i], i / 3);
        }
        const Image after = sumOfTerms(frame);
        float* const lit_data = dataOf(frame, Channel::lit);
        for (std::size_t i = 0; i < after.data.size(); ++i)
            if (after.data[i] != before.data[i]) lit_data[i] = after.data[i];
    };
}

// Changes lit alone.
std::function<void(InjectedView&, Frame&)> output(
    const std::function<void(float*, const float* emitted)>& of) {
    return [of](InjectedView& view, Frame& frame) {
        Image& image = frame.channels.at(Channel::lit);
        const Image& emitted_light = frame.channels.at(Channel::emission);
        for (std::size_t p = 0; p < image.pixels(); ++p)
            if (view.covered(p)) of(image.pixel(p), emitted_light.pixel(p));
    };
}

std::function<void(InjectedView&, Frame&)> exposed(float factor) {
    return [factor](InjectedView&, Frame& frame) {
        for (float& value : frame.channels.at(Channel::lit).data) value *= factor;
    };
}

// The correct image, except that a tile of 24 x 16 pixels lacks the light with the largest effect there.
void dropFromTile(InjectedView& view, Frame& frame) {
    InjectedFault without{"a light is dropped", {}};
    double max = 0;
    Frame dropped;
    for (std::size_t light = 0; light < view.scene.lights.size(); ++light) {
        without.draw = [light](Settings&, Scene& scene) {
            scene.lights.erase(scene.lights.begin() + static_cast<std::ptrdiff_t>(light));
        };
        without.means = fmt::format("light {} is dropped", light);
        Frame other = view.with(without);
        double sum = 0;
        for (int y = 8; y < 24; ++y)
            for (int x = 16; x < 40; ++x)
                sum += std::abs(double{other.channels.at(Channel::lit).at(x, y, 1)} -
                                frame.channels.at(Channel::lit).at(x, y, 1));
        if (sum > max) max = sum, dropped = std::move(other);
    }
    if (max == 0) return;
    std::vector<Channel> modes = termChannels();
    modes.push_back(Channel::lit);
    modes.push_back(Channel::light_count);
    for (const Channel mode : modes) {
        Image& image = frame.channels.at(mode);
        for (int y = 8; y < 24; ++y)
            for (int x = 16; x < 40; ++x)
                for (int c = 0; c < image.components; ++c)
                    image.at(x, y, c) = std::as_const(dropped).channels.at(mode).at(x, y, c);
    }
}

// Blended surfaces without haze, over opaque ones with haze: over = T under + B. T is the response to
// additional light under them.
void hazeOnOpaqueOnly(InjectedView& view, Frame& frame) {
    Settings clear = view.settings, bare = view.settings;
    clear.haze = false;
    bare.transparency = Transparency::off;
    Settings neither = clear;
    neither.transparency = Transparency::off;
    const auto more = [](float* p) {
        for (int c = 0; c < 3; ++c) p[c] += 1;
    };
    const Image under = view.litUnder(bare), over_clear = view.litUnder(clear),
                under_clear = view.litUnder(neither), brighter = view.litUnder(clear, "emission", more);
    Image& image = frame.channels.at(Channel::lit);
    for (std::size_t i = 0; i < image.data.size(); ++i) {
        if (!view.covered(i / 3) || over_clear.data[i] == under_clear.data[i]) continue;
        const float through = brighter.data[i] - over_clear.data[i];
        image.data[i] = under.data[i] * through + (over_clear.data[i] - under_clear.data[i] * through);
    }
}

void addChannelFaults(std::vector<InjectedFault>& all) {
    const auto add = [&](std::string channel, const char* means, std::function<void(float*)> pixel) {
        all.push_back({channel + " " + means, {channel}, ViewKind::opaque, false, channel, std::move(pixel)});
    };
    const auto bits = [](double steps) {
        return [steps](double x) { return std::round(steps * x) / steps; };
    };
    const auto bgr = [](float* p) { std::swap(p[0], p[2]); };
    add("normals", "of 8 bits", [=](float* p) { each(bits(127))(p), normalize(p); });
    add("normals", "of 5 bits", [=](float* p) { each(bits(15))(p), normalize(p); });
    add("normals", "with y and z swapped", [](float* p) { std::swap(p[1], p[2]); });
    add("normals", "flattened", [](float* p) { p[0] *= 0.8f, normalize(p); });
    add("roughness", "squared twice", each([](double x) { return x * x; }, 1));
    add("roughness", "taken for its square", each([](double x) { return std::sqrt(x); }, 1));
    add("roughness", "of 3 bits", each(bits(7), 1));
    add("roughness", "inverted: glossiness", each([](double x) { return 1 - x; }, 1));
    add("roughness", "at least 0.6", each([](double x) { return std::max(x, 0.6); }, 1));
    add("metallic", "of plastic", each([](double) { return 0.0; }, 1));
    add("metallic", "halved", each([](double x) { return 0.5 * x; }, 1));
    add("metallic", "inverted", each([](double x) { return 1 - x; }, 1));
    add("albedo", "sRGB taken for linear", each(encodedSrgb));
    add("albedo", "decoded twice", each(decodedSrgb));
    add("albedo", "of 4 bits", each(bits(15)));
    add("albedo", "as BGR", bgr);
    add("albedo", "without its texture", each([](double) { return 0.5; }));
    add("emission", "clamped at 1", each([](double x) { return std::min(x, 1.0); }));
    add("emission", "left out", each([](double) { return 0.0; }));
    add("emission", "doubled", each([](double x) { return 2 * x; }));
    add("emission", "as BGR", bgr);
    add("occlusion", "left out", each([](double) { return 1.0; }, 1));
    add("occlusion", "squared", each([](double x) { return x * x; }, 1));
    add("occlusion", "inverted", each([](double x) { return 1 - x; }, 1));
    add("dielectric_f0", "of water", each([](double x) { return 0.5 * x; }));
    add("dielectric_f0", "doubled", each([](double x) { return 2 * x; }));
    add("dielectric_f90", "0", each([](double) { return 0.0; }, 1));
    add("position", "5 cm off", [](float* p) { p[1] += 0.05f; });
    add("position", "of halves", each([](double x) { return std::round(512 * x / 8) * 8 / 512; }));
}

void addLightFaults(std::vector<InjectedFault>& all) {
    const std::vector<std::string> direct{"direct diffuse", "direct specular"};
    const auto lights = [&](const char* means, const std::vector<std::string>& named,
                            const std::function<void(Light&)>& of, bool first_alone = false) {
        all.push_back(
            {means, named, ViewKind::opaque, first_alone, {}, {}, [of, first_alone](Settings&, Scene& scene) {
                 for (Light& light : scene.lights) {
                     of(light);
                     if (first_alone) break;
                 }
             }});
    };
    all.push_back({"a light is dropped from one tile",
                   {"light_count"},
                   ViewKind::opaque,
                   false,
                   {},
                   {},
                   {},
                   dropFromTile});
    all.push_back(
        {"a light is dropped", {"light_count"}, ViewKind::opaque, true, {}, {}, [](Settings&, Scene& scene) {
             scene.lights.erase(scene.lights.begin());
         }});
    lights("suns are twice as bright", direct, [](Light& light) {
        if (light.kind == LightKind::directional) light.intensity *= 2;
    });
    lights(
        "one light's colour is BGR", direct, [](Light& light) { std::swap(light.color.r, light.color.b); },
        true);
    lights("spots are half as wide", direct, [](Light& light) {
        if (light.kind == LightKind::spot) light.inner_cone *= 0.5f, light.outer_cone *= 0.5f;
    });
    lights("spots have hard edges", direct, [](Light& light) {
        if (light.kind == LightKind::spot) light.inner_cone = light.outer_cone * 0.999f;
    });
    lights("ranges are half as long", direct, [](Light& light) { light.range *= 0.6f; });
    lights("ranges are ignored", direct,
           [](Light& light) { light.range = std::numeric_limits<float>::infinity(); });
    lights("lights are 30 cm off", direct, [](Light& light) { light.position.x += 0.3; });
    lights("candela are taken for lumen", direct, [](Light& light) {
        if (light.kind != LightKind::directional) light.intensity /= static_cast<float>(4 * std::numbers::pi);
    });
    const std::vector<std::string> shadows{"shadow_visibility", "local_visibility"};
    const auto setting = [&](const char* means, const std::vector<std::string>& named,
                             const std::function<void(Settings&)>& of, ViewKind kind = ViewKind::opaque) {
        all.push_back(
            {means, named, kind, false, {}, {}, [of](Settings& settings, Scene&) { of(settings); }});
    };
    setting("shadow bias is tripled", shadows, [](Settings& s) { s.shadow_bias *= 3; });
    // A coarser cascade is used, and filters cover more texels.
    setting("cascade is one off", {"shadow_visibility"}, [](Settings& s) {
        s.shadow_cascades -= 1;
        s.shadow_distance = 60;
        s.shadow_kernel = 5;
    });
    setting("the shadow filter is twice as wide", shadows, [](Settings& s) { s.shadow_kernel = 7; });
    setting("shadow maps have half the texels", shadows, [](Settings& s) { s.shadow_size /= 2; });
    setting("there are no shadows", shadows, [](Settings& s) {
        s.shadows = Shadows::off;
        s.shadow_lights = 0;
        s.shadow_cascades = Settings().shadow_cascades;
    });
    setting("points and spots cast no shadows", {"local_visibility"},
            [](Settings& s) { s.shadow_lights = 0; });
    setting("light between microfacets is added", {"direct diffuse", "direct specular"},
            [](Settings& s) { s.multiscatter = Multiscatter::energy; });
    setting("ambient light is doubled", {"--ambient"}, [](Settings& s) {
        s.ambient = {2 * s.ambient.r, 2 * s.ambient.g, 2 * s.ambient.b};
    });
    setting("ambient light is left out", {"--ambient"}, [](Settings& s) { s.ambient = {}; });
    setting("haze is twice as dense", {"--haze-density"}, [](Settings& s) { s.haze_density *= 2; });
    setting("haze is left out", {"--haze"}, [](Settings& s) { s.haze = false; });

    setting(
        "an environment is turned by 90 degrees", {"--env-rotation"},
        [](Settings& s) { s.env_rotation += 90; }, ViewKind::blended);
    setting(
        "an environment is turned by 180 degrees", {"--env-rotation"},
        [](Settings& s) { s.env_rotation += 180; }, ViewKind::blended);
    setting(
        "an environment is twice as bright", {"--ibl-intensity"}, [](Settings& s) { s.ibl_intensity *= 2; },
        ViewKind::blended);
    setting(
        "blended surfaces are left out", {"transparency"},
        [](Settings& s) { s.transparency = Transparency::off; }, ViewKind::blended);
    setting(
        "blended surfaces are weighted", {"transparency"},
        [](Settings& s) { s.transparency = Transparency::weighted; }, ViewKind::blended);
    all.push_back({"haze is on opaque surfaces only",
                   {"transparency"},
                   ViewKind::blended,
                   false,
                   {},
                   {},
                   {},
                   hazeOnOpaqueOnly});
    all.push_back({"the background is left out",
                   {"background"},
                   ViewKind::blended,
                   false,
                   {},
                   {},
                   {},
                   [](InjectedView& view, Frame& frame) {
                       Settings bare = view.settings;
                       bare.transparency = Transparency::off;
                       const Image under = view.litUnder(bare);
                       Image& image = frame.channels.at(Channel::lit);
                       for (std::size_t i = 0; i < image.data.size(); ++i)
                           if (!view.covered(i / 3) && image.data[i] == under.data[i]) image.data[i] = 0;
                   }});
}

void addTermFaults(std::vector<InjectedFault>& all) {
    const auto add = [&](const char* means, std::vector<std::string> named,
                         std::function<void(InjectedView&, Frame&)> after) {
        all.push_back({means, std::move(named), ViewKind::opaque, false, {}, {}, {}, std::move(after)});
    };
    const auto by = [](float factor) {
        return [factor](float value, std::size_t) { return factor * value; };
    };
    constexpr float pi = std::numbers::pi_v<float>;
    add("the specular lobe is left out", {"direct specular"}, term({Channel::lit_specular}, by(0)));
    add("the specular lobe lacks its 4", {"direct specular"}, term({Channel::lit_specular}, by(4)));
    add("the diffuse lobe lacks its pi", {"direct diffuse"}, term({Channel::lit_diffuse}, by(pi)));
    add("the diffuse lobe is divided by pi twice", {"direct diffuse"},
        term({Channel::lit_diffuse}, by(1 / pi)));
    add("diffuse light in three steps", {"direct diffuse"},
        term({Channel::lit_diffuse}, [](float value, std::size_t) { return std::floor(8 * value) / 8; }));
    add("occlusion is left out of ambient light", {"ambient light"}, [](InjectedView& view, Frame& frame) {
        const Image occluded = view.right.channels.at(Channel::occlusion);
        term({Channel::lit_ambient}, [&](float value, std::size_t pixel) {
            return occluded.pixel(pixel)[0] > 0 ? value / occluded.pixel(pixel)[0] : value;
        })(view, frame);
    });
    add("occlusion darkens lights as well", {"direct diffuse", "direct specular"},
        [](InjectedView& view, Frame& frame) {
            const Image occluded = view.right.channels.at(Channel::occlusion);
            term({Channel::lit_diffuse, Channel::lit_specular}, [&](float value, std::size_t pixel) {
                return value * occluded.pixel(pixel)[0];
            })(view, frame);
        });
    add("haze adds no light", {"haze in the air"}, term({Channel::lit_haze}, by(0)));
    add("haze takes no light", {"haze in the air"},
        term({Channel::transmittance}, [](float, std::size_t) { return 1.0f; }));
    add("emission is missing from the sum", {"sum with emission"}, [](InjectedView& view, Frame& frame) {
        const Image through = frame.channels.at(Channel::transmittance);
        const Image& emitted_light = frame.channels.at(Channel::emission);
        Image& image = frame.channels.at(Channel::lit);
        for (std::size_t i = 0; i < image.data.size(); ++i)
            if (view.covered(i / 3)) image.data[i] -= emitted_light.data[i] * through.data[i];
    });
    add("emission is in the sum twice", {"sum with emission"}, [](InjectedView& view, Frame& frame) {
        const Image through = frame.channels.at(Channel::transmittance);
        const Image& emitted_light = frame.channels.at(Channel::emission);
        Image& image = frame.channels.at(Channel::lit);
        for (std::size_t i = 0; i < image.data.size(); ++i)
            if (view.covered(i / 3)) image.data[i] += emitted_light.data[i] * through.data[i];
    });
    add("lit is BGR", {"sum of terms"}, output([](float* p, const float*) { std::swap(p[0], p[2]); }));
    add("lit is encoded as sRGB", {"sum of terms"},
        output([](float* p, const float*) { each(encodedSrgb)(p); }));
    add("lit is clamped at 0.3", {"sum of terms"},
        output([](float* p, const float*) { each([](double x) { return std::min(x, 0.3); })(p); }));
    add("exposure is doubled", {"exposure"}, exposed(2));
    add("exposure is halved", {"exposure"}, exposed(0.5f));
    add("exposure is a third of a stop off", {"exposure"}, exposed(1.2599f));
}

}  // namespace

const std::vector<InjectedFault>& injectedFaults() {
    static const std::vector<InjectedFault> faults = [] {
        std::vector<InjectedFault> all;
        addChannelFaults(all);
        addLightFaults(all);
        addTermFaults(all);
        return all;
    }();
    return faults;
}

const InjectedFault& injectedFault(std::string_view means) {
    for (const InjectedFault& fault : injectedFaults())
        if (fault.means == means) return fault;
    throw std::out_of_range("no fault is called " + std::string(means));
}

}  // namespace diptych::tests
