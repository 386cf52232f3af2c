// SPDX-License-Identifier: MIT
#include "compare/explain/explain.h"

#include "compare/explain/by_light.h"
#include "compare/explain/exposure.h"
#include "compare/explain/lighting_stages.h"
#include "compare/metrics/flip.h"
#include "compare/render/channel_shading.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/lights/casters.h"
#include "shared/scene/model/luminance.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace diptych {

namespace {

constexpr int litMode = static_cast<int>(gpu::DEBUG_lit), idMode = static_cast<int>(gpu::DEBUG_material_id),
              lightmapMode = static_cast<int>(gpu::DEBUG_lightmap),
              emissionMode = static_cast<int>(gpu::DEBUG_emission);
constexpr int sampledOrderCount = 40;  // beyond mostExactCauses; each of as many subsets as there are causes
constexpr double namedPair = 0.05;
// Where the test's lit is not as its Settings say, others are tried: an environment turned by so many degrees
// more, as by an axis that is taken for another; light from all around or haze that is a multiple of what is
// said, or none. Believed are those that bring it nearer by at least half of what they change, and where no
// term says so and the multiple is a guess, that leave less than half of the rest; as many as this together.
constexpr std::array triedTurns{90.0f, 180.0f, 270.0f};
constexpr double believedRest = 0.5;
constexpr int mostBelieved = 3;
constexpr double leastBrighter = 0.01;
// Lights that are drawn alone: so many, and no more than a gigabyte of what two pictures of each hold.
constexpr std::size_t mostLightsDrawn = 32, mostLightBytes = std::size_t{1} << 30;

// Settings that are no cause of their own: what they change is in the channels, in the rest, or in no pixel.
// clang-format off
constexpr std::string_view carried[] = {
    "path", "gbuffer", "prepass", "assign", "light-kernel", "pixel-lights", "skinning", "spec-aa",
    "spec-aa-variance", "spec-aa-limit", "spec-aa-normals", "msaa", "msaa-shading", "msaa-edges", "resolve",
    "alpha-to-coverage", "spp", "reference-mode"};
// clang-format on

// Settings of shadows and of what single lights send.
bool isOfLights(std::string_view option) {
    return option.starts_with("shadow") || option.starts_with("evsm") || option.starts_with("clipmap") ||
           option == "light-cutoff" || option == "area-lights";
}

const char* kindName(LightKind kind) {
    switch (kind) {
        case LightKind::directional:
            return "directional";
        case LightKind::point:
            return "point";
        case LightKind::spot:
            return "spot";
        case LightKind::rect:
            return "rectangle";
        case LightKind::disc:
            return "disc";
        case LightKind::tube:
            return "tube";
    }
    return "light";
}

bool lightsSurfaces(std::string_view option) {
    return std::ranges::find(carried, option) == std::end(carried);
}

std::size_t sizeOf(int count) {
    return static_cast<std::size_t>(count);
}

const Image& channelOf(const Frame& frame, int mode) {
    const auto found = frame.channels.find(mode);
    if (found == frame.channels.end())
        throw std::runtime_error(fmt::format("{} has no channel {}, which an explanation needs", frame.name,
                                             debugMode(mode).name));
    return found->second;
}

// Mean |a - b| of the components of each pixel; 0 where a component is not finite.
void errorsOf(const Image& a, const Image& b, std::vector<double>& errors) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, a.pixels(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const float *const x = a.pixel(i), *const y = b.pixel(i);
            const double sum =
                std::abs(double{x[0]} - y[0]) + std::abs(double{x[1]} - y[1]) + std::abs(double{x[2]} - y[2]);
            errors[i] = std::isfinite(sum) ? sum / 3 : 0.0;
        }
    });
}

bool sameBits(const Image& a, const Image& b) {
    return a.data.size() == b.data.size() &&
           std::memcmp(a.data.data(), b.data.data(), a.data.size() * sizeof(float)) == 0;
}

// The material that a pixel of channel material_id names; -1: none, or a file holds no such number.
int materialOf(const float* pixel, const Scene& scene) {
    const float id = *pixel;
    return id >= 0 && id < static_cast<float>(scene.materials.size()) ? static_cast<int>(id) : -1;
}

double meanOf(const std::vector<double>& values) {
    // In order: the same whatever the number of threads.
    return values.empty()
               ? 0.0
               : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

class Explainer {
public:
    Explainer(Device& device, Renderer& renderer, const Scene& scene, const Frame& baseline,
              const Frame& test, const Stage& progress)
        : renderer_(renderer),
          scene_(scene),
          frames_{&baseline, &test},
          settings_{baseline.settings, test.settings},
          progress_(progress),
          images_(device, baseline.settings.size),
          lit_{&channelOf(baseline, litMode), &channelOf(test, litMode)} {
        for (const Frame* const frame : frames_)
            for (const int mode : explainedChannels()) {
                const Image& image = channelOf(*frame, mode);
                if (image.width != lit_[0]->width || image.height != lit_[0]->height)
                    throw std::runtime_error(
                        fmt::format("{}: {} is {}x{}, and lit of {} {}x{}: an explanation is "
                                    "of two pictures of one size",
                                    frame->name, debugMode(mode).name, image.width, image.height,
                                    baseline.name, lit_[0]->width, lit_[0]->height));
            }
        for (std::size_t p = 0; p < lit_[0]->pixels(); ++p) {
            const auto finite = [p](const Image* image) {
                const float* c = image->pixel(p);
                return std::isfinite(c[0]) && std::isfinite(c[1]) && std::isfinite(c[2]);
            };
            found_.nonfinite += !finite(lit_[0]) || !finite(lit_[1]);
        }
        for (const std::string_view option : {"camera", "time", "animation", "env", "lights", "seed"})
            if (baseline.settings.valueOf(option) != test.settings.valueOf(option))
                throw std::runtime_error(
                    fmt::format("--{} {} and {}: an explanation is of two pictures of one view of one scene",
                                option, baseline.settings.valueOf(option), test.settings.valueOf(option)));
        errors_.resize(lit_[0]->pixels());
    }

    Explanation make() {
        errorsOf(*lit_[1], *lit_[0], errors_);
        found_.distance = meanOf(errors_);
        upload();
        findRest();
        found_.dominant = Image(lit_[0]->width, lit_[0]->height, 1, -1.0f);
        found_.unexplained_map = imageOf(errors_);
        if (found_.distance > 0) {
            findExposure();
            findUnsaid();
            findCauses();
            share();
        }
        found_.frames = drawn_;
        return std::move(found_);
    }

private:
    enum class Kind { channel, rest, stage, exposure, setting };
    struct Swapped {
        Kind kind;
        std::size_t place = 0;  // of surfaceChannels(), or of LightingStages::stages()
        std::string name, shows;
    };

    static std::string nameOfCause(const Swapped& cause) {
        return (cause.kind == Kind::setting ? "--" : "") + cause.name;
    }

    // Pixels of a side whose material has a lightmap.
    std::vector<std::uint8_t> lightmapped(std::size_t side) const {
        const Image& ids = channelOf(*frames_.at(side), idMode);
        std::vector<std::uint8_t> has(ids.pixels());
        for (std::size_t i = 0; i < has.size(); ++i) {
            const int id = materialOf(ids.pixel(i), scene_);
            has[i] = id >= 0 && scene_.materials[sizeOf(id)].lightmap_texture.texture >= 0;
        }
        return has;
    }

    void upload() {
        for (std::size_t c = 0; c < surfaceChannels().size(); ++c) {
            const int mode = surfaceChannels()[c];
            const Image &a = channelOf(*frames_[0], mode), &b = channelOf(*frames_[1], mode);
            const bool same = sameBits(a, b);
            for (std::size_t side = 0; side < (same ? 1u : 2u); ++side)
                images_.set(side, c, side == 0 ? a : b,
                            mode == lightmapMode ? lightmapped(side) : std::vector<std::uint8_t>{});
            if (!same) channel_causes_.push_back(c);
        }
    }

    // The Settings as far as they light surfaces: what is in channels is the baseline's, so that two pictures
    // that differ in that alone are lit by one frame.
    Settings lightingOf(Settings settings) const {
        for (const std::string_view option : carried) settings.set(option, settings_[0].valueOf(option));
        return settings;
    }

    // Lighting under Settings, of which a frame is drawn where they light otherwise than the last ones.
    void light(const Settings& given) {
        const Settings settings = lightingOf(given);
        if (!shading_ || !(*shaded_settings_ == settings)) {
            shading_.reset();
            shading_.emplace(renderer_.shadeChannels(settings, images_));
            shaded_settings_ = settings;
            ++drawn_;
        }
    }

    // lit of surfaces under Settings.
    const Image& shade(const Settings& settings, std::uint32_t sides) {
        light(settings);
        ++found_.subsets;
        shaded_ = shading_->shade(sides);
        return shaded_;
    }

    // What the lighting of a side's own channels leaves of its lit.
    void findRest() {
        for (std::size_t side = 0; side < 2; ++side) {
            const Frame& frame = *frames_.at(side);
            const std::uint32_t sides = side == 0 ? 0u : ~0u;
            const Image& own = shade(frame.settings, sides);
            const Image& all = *lit_.at(side);
            own_.at(side) = own;
            Image& rest = rest_.at(side) = Image(all.width, all.height, 3);
            double sum = 0, off = 0;
            for (std::size_t i = 0; i < all.data.size(); ++i) {
                const double value = std::as_const(all.data)[i], left = value - std::as_const(own.data)[i];
                if (!std::isfinite(left)) continue;
                rest.data[i] = static_cast<float>(left);
                sum += std::abs(value);
                off += std::abs(left);
            }
            found_.reproduction.at(side) = sum > 0 ? off / sum : off > 0 ? 1 : 0;
        }
    }

    // A factor on all of the test's lit: beyond the sum of its terms, or else beyond our lighting of its
    // channels, or else beyond the baseline's lit.
    void findExposure() {
        if (sameBits(rest_[0], rest_[1])) return;
        const bool terms = haveTerms(*frames_[0], *frames_[1]);
        const auto factor = [&](std::size_t side) {
            return commonFactor(*lit_.at(side), terms ? sumOfTerms(*frames_.at(side)) : own_.at(side));
        };
        const std::array<std::optional<double>, 2> factors{factor(0), factor(1)};
        std::optional<double> found = exposureBetween(factors[0], factors[1]);
        if (!found && !(factors[0] && factors[1]))
            found = exposureBetween(1.0, commonFactor(*lit_[1], *lit_[0]));
        if (!found) return;
        exposure_ = static_cast<float>(*found);
        unexposed_ = *lit_[1];
        for (float& value : unexposed_.data) value /= exposure_;
        exposed_ = *lit_[1];
        lit_[1] = &unexposed_;
        rest_[1] = restOf(own_[1]);
    }

    // What the test's lit has, without exposure, beyond a lighting of its channels.
    Image restOf(const Image& own) const {
        Image rest(own.width, own.height, 3);
        for (std::size_t i = 0; i < rest.data.size(); ++i) {
            const float left = std::as_const(*lit_[1]).data[i] - own.data[i];
            if (std::isfinite(left)) rest.data[i] = left;
        }
        return rest;
    }

    // A Setting that the test may have without saying so.
    struct Unsaid {
        std::string_view option;
        Settings settings;
        std::string shows;
        bool guessed = false;  // a multiple that no term says
    };

    std::vector<Unsaid> triedSettings() {
        std::vector<Unsaid> all;
        const Settings& said = settings_[1];
        const auto tryIt = [&](std::string_view option, std::string shows, bool guessed, const auto& change) {
            if (std::ranges::any_of(unsaid_, [&](const Unsaid& one) { return one.option == option; })) return;
            all.push_back({option, said, std::move(shows), guessed});
            change(all.back().settings);
        };
        const bool lit_around = said.env != Settings().env && said.ibl_intensity > 0;
        for (const float turn : triedTurns)
            if (lit_around)
                tryIt("env-rotation",
                      fmt::format(
                          "an environment that is turned by {} degrees more than the test's Settings say",
                          turn),
                      false, [&](Settings& s) { s.env_rotation += turn; });
        const auto multiple = [](const char* what, double factor) {
            return fmt::format("{} that is {:.4g} times what the test's Settings say", what, factor);
        };
        const TermFactors factors = factorsOfTerms();
        const auto brighter = [&](std::string_view option, const char* what, std::optional<double> known,
                                  const auto& change) {
            Settings none = said;
            change(none, 0.0f);
            const double factor = known ? *known : brightness(none);
            if (std::abs(factor - 1) > leastBrighter)
                tryIt(option, multiple(what, factor), !known,
                      [&](Settings& s) { change(s, static_cast<float>(factor)); });
        };
        const bool ambient = said.ambient.r > 0 || said.ambient.g > 0 || said.ambient.b > 0;
        if (ambient && (!factors.known || factors.ambient))
            brighter("ambient", "ambient light", factors.ambient, [](Settings& s, float by) {
                s.ambient = {by * s.ambient.r, by * s.ambient.g, by * s.ambient.b};
            });
        if (lit_around)
            brighter("ibl-intensity", "light of the environment", {},
                     [](Settings& s, float by) { s.ibl_intensity *= by; });
        if (said.haze && (!factors.known || factors.no_haze))
            tryIt("haze", "no haze, although the test's Settings say so", !factors.known,
                  [](Settings& s) { s.haze = false; });
        if (said.haze && factors.haze)
            tryIt("haze-density", multiple("density", *factors.haze), false,
                  [&](Settings& s) { s.haze_density *= static_cast<float>(*factors.haze); });
        return all;
    }

    // By how much brighter that light is which these Settings lack: the median of what is missing, as a
    // multiple of what it adds, and 1.
    double brightness(const Settings& without) {
        const Image with = comparable(settings_[1], 1), none = comparable(without, 1);
        std::vector<double> adds(with.data.size());
        double sum = 0;
        for (std::size_t i = 0; i < adds.size(); ++i) {
            adds[i] = double{std::as_const(with).data[i]} - std::as_const(none).data[i];
            if (std::isfinite(adds[i])) sum += std::abs(adds[i]);
        }
        const double least = 1e-3 * sum / static_cast<double>(adds.size());
        std::vector<double> ratios;
        for (std::size_t i = 0; i < adds.size(); ++i) {
            const double missing =
                double{std::as_const(unlike_[1]).data[i]} - std::as_const(unlike_[0]).data[i];
            if (adds[i] > least && std::isfinite(missing)) ratios.push_back(missing / adds[i]);
        }
        if (ratios.empty()) return 1;
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::ranges::nth_element(ratios, middle);
        const double factor = 1 + *middle;
        return factor < leastBrighter ? 0.0 : factor;
    }

    // What the test's terms are of ours, where they are that alike everywhere.
    struct TermFactors {
        bool known = false;  // there are terms
        bool no_haze = false;
        std::optional<double> ambient{}, haze{};  // other than 1; haze: its density
    };
    TermFactors factorsOfTerms() {
        if (!haveTerms(*frames_[0], *frames_[1])) return {};
        light(settings_[1]);
        const ChannelTerms terms = shading_->terms(~0u);
        const auto theirs = [&](gpu::uint mode) -> const Image& {
            return channelOf(*frames_[1], static_cast<int>(mode));
        };
        const Image& ids = channelOf(*frames_[1], idMode);
        Image depth = theirs(gpu::DEBUG_transmittance), our_depth = terms.transmittance;
        bool hazy = false, dark = true;
        for (std::size_t i = 0; i < depth.data.size(); ++i) {
            const bool surface = ids.pixel(i / 3)[0] >= 0;
            // Density is what the logarithm of the transmittance is proportional to.
            depth.data[i] = surface ? -std::log(depth.data[i]) : 0;
            our_depth.data[i] = surface ? -std::log(our_depth.data[i]) : 0;
            hazy = hazy || depth.data[i] != 0 || theirs(gpu::DEBUG_lit_haze).data[i] != 0;
            dark = dark && theirs(gpu::DEBUG_lit_ambient).data[i] == 0;
        }
        return {true, !hazy,
                dark ? std::optional(0.0)
                     : exposureBetween(1.0, commonFactor(theirs(gpu::DEBUG_lit_ambient), terms.ambient)),
                exposureBetween(1.0, commonFactor(depth, our_depth))};
    }

    // What is compared to tell Settings that are not said: a side's surfaces under some Settings as our terms
    // add up, where both have terms, so that what is done with them afterwards does not matter; else our lit.
    Image comparable(const Settings& settings, std::size_t side) {
        const std::uint32_t sides = side == 0 ? 0u : ~0u;
        if (!haveTerms(*frames_[0], *frames_[1])) return shade(settings, sides);
        light(settings);
        return sumOfTerms(shading_->terms(sides), channelOf(*frames_.at(side), emissionMode));
    }
    bool bringsHazeNearer(const Settings& tried) {
        if (!haveTerms(*frames_[0], *frames_[1])) return true;
        const Image& theirs = channelOf(*frames_[1], static_cast<int>(gpu::DEBUG_lit_haze));
        std::vector<double> apart(errors_.size());
        const auto off = [&](const Settings& settings) {
            light(settings);
            errorsOf(shading_->terms(~0u).haze, theirs, apart);
            return meanOf(apart);
        };
        return off(tried) <= off(settings_[1]);
    }
    // What a side has beyond that.
    Image beyond(const Image& ours, std::size_t side) const {
        const Image theirs =
            haveTerms(*frames_[0], *frames_[1]) ? sumOfTerms(*frames_.at(side)) : *lit_.at(side);
        Image left(ours.width, ours.height, 3);
        for (std::size_t i = 0; i < left.data.size(); ++i) {
            const float more = theirs.data[i] - ours.data[i];
            if (std::isfinite(more)) left.data[i] = more;
        }
        return left;
    }

    // Settings that the test has without saying so: they are taken to be said.
    void findUnsaid() {
        if (!restName().empty() || sameBits(rest_[0], rest_[1])) return;
        for (std::size_t side = 0; side < 2; ++side)
            unlike_.at(side) = beyond(comparable(settings_.at(side), side), side);
        if (sameBits(unlike_[0], unlike_[1])) return;
        std::vector<double> apart(errors_.size());
        errorsOf(unlike_[1], unlike_[0], apart);
        double left = meanOf(apart);
        for (int believed = 0; believed < mostBelieved && left > 0; ++believed) {
            double least = left;
            std::optional<Unsaid> best;
            const Image said = comparable(settings_[1], 1);
            for (Unsaid& tried : triedSettings()) {
                const Image ours = comparable(tried.settings, 1);
                // Ambient light that is really another is in the air as well.
                if (tried.option == "ambient" && settings_[1].haze && !bringsHazeNearer(tried.settings))
                    continue;
                errorsOf(ours, said, apart);
                const double changed = meanOf(apart);
                errorsOf(beyond(ours, 1), unlike_[0], apart);
                const double rest = meanOf(apart);
                if (!(rest < least) || !(left - rest > believedRest * changed) ||
                    (tried.guessed && !(rest < believedRest * left)))
                    continue;
                least = rest;
                best = std::move(tried);
            }
            if (!best) break;
            left = least;
            settings_[1] = best->settings;
            unlike_[1] = beyond(comparable(settings_[1], 1), 1);
            unsaid_.push_back(std::move(*best));
        }
        if (unsaid_.empty()) return;
        own_[1] = shade(settings_[1], ~0u);
        rest_[1] = restOf(own_[1]);
    }

    // What the rest is where it is known what makes it; empty: it is what no cause explains.
    std::string restName() const {
        const auto either = [&](const auto& is) {
            return is(frames_[0]->settings) || is(frames_[1]->settings);
        };
        if (either([](const Settings& s) { return s.msaa > 1; })) return "samples of a pixel";
        if (either([](const Settings& s) { return s.assign == Assignment::per_object; }))
            return "lights per object";
        return {};
    }

    // Where both say the terms of their lit, in which of them the rest is.
    void findStages() {
        if (!restName().empty() || sameBits(rest_[0], rest_[1]) || !haveTerms(*frames_[0], *frames_[1]))
            return;
        std::array<LitSurfaces, 2> own;
        for (std::size_t side = 0; side < 2; ++side)
            own.at(side) = surfaces(settings_.at(side), side == 0 ? 0u : ~0u);
        // Afterwards, because they need a frame of their own.
        const bool blended = std::ranges::any_of(scene_.materials, blends);
        for (std::size_t side = 0; side < 2; ++side) {
            if (!blended) {
                own.at(side).unblended = own.at(side).lit;
                continue;
            }
            Settings bare = settings_.at(side);
            bare.transparency = Transparency::off;
            own.at(side).unblended = shade(bare, side == 0 ? 0u : ~0u);
        }
        stages_.emplace(*frames_[0], *frames_[1], *lit_[1], own);
    }

    // Our lighting of surfaces, and its terms.
    LitSurfaces surfaces(const Settings& settings, std::uint32_t sides) {
        LitSurfaces made{shade(settings, sides), shading_->terms(sides), nullptr, {}};
        const auto channel = static_cast<std::size_t>(std::ranges::find(surfaceChannels(), emissionMode) -
                                                      surfaceChannels().begin());
        made.emission = &channelOf(*frames_.at(sides >> channel & 1u), emissionMode);
        return made;
    }

    void findCauses() {
        const Settings &a = settings_[0], &b = settings_[1];
        std::vector<Swapped> settings;
        for (const Field& field : settingFields()) {
            const std::string_view option = field.option;
            if (!lightsSurfaces(option) || a.valueOf(option) == b.valueOf(option)) continue;
            const auto unsaid =
                std::ranges::find(unsaid_, option, [](const Unsaid& one) { return one.option; });
            settings.push_back({Kind::setting, 0, std::string(option),
                                unsaid != unsaid_.end()
                                    ? unsaid->shows
                                    : fmt::format("{} instead of {}", b.valueOf(option), a.valueOf(option))});
        }
        const std::vector<std::size_t> inert = inertChannels();
        for (const std::size_t c : channel_causes_) {
            const DebugMode& mode = debugMode(surfaceChannels()[c]);
            Swapped cause{Kind::channel, c, std::string(mode.name), std::string(mode.shows)};
            if (std::ranges::count(inert, c) > 0)
                found_.inert.push_back(cause.name);
            else
                causes_.push_back(std::move(cause));
        }
        if (!restName().empty() && !sameBits(rest_[0], rest_[1]))
            causes_.push_back(
                {Kind::rest, 0, restName(), "what the lighting of a side's own channels leaves of its lit"});
        findStages();
        for (std::size_t i = 0; stages_ && i < stages_->stages().size(); ++i)
            causes_.push_back({Kind::stage, i, stages_->stages()[i].name, stages_->stages()[i].shows});
        if (exposure_ != 1)
            causes_.push_back({Kind::exposure, 0, "exposure",
                               fmt::format("a factor of {:.4g} on all of lit", double{exposure_})});
        // Last, so that subsets of the same Settings follow each other: they need a frame each.
        causes_.insert(causes_.end(), settings.begin(), settings.end());
        if (causes_.size() > sizeOf(mostCauses))
            throw std::runtime_error(
                fmt::format("{} causes are more than the {} that can be told apart: give the "
                            "two pictures Settings that are more alike",
                            causes_.size(), mostCauses));
    }

    // The channels that differ and change no pixel: swapped alone, and when all others are.
    std::vector<std::size_t> inertChannels() {
        std::vector<std::size_t> inert = channel_causes_;
        for (const std::size_t side : {1, 0}) {
            const Settings& settings = settings_.at(side);
            const std::uint32_t all = side == 0 ? 0u : ~0u;
            const Image whole = shade(settings, all);
            std::erase_if(inert, [&](std::size_t channel) {
                return !sameBits(whole, shade(settings, all ^ std::uint32_t{1} << channel));
            });
        }
        return inert;
    }

    // lit of the test with a subset of the causes taken from the baseline.
    Image swapped(Subset subset) {
        if (subset == 0) return exposure_ == 1 ? *lit_[1] : exposed_;
        std::uint32_t sides = ~0u;
        std::vector<bool> stages(stages_ ? stages_->stages().size() : 0);
        std::size_t rest = 1;
        Settings settings = settings_[1];
        float exposure = exposure_;
        for (std::size_t i = 0; i < causes_.size(); ++i) {
            if ((subset >> i & 1) == 0) continue;
            const Swapped& cause = causes_[i];
            if (cause.kind == Kind::channel) sides &= ~(std::uint32_t{1} << cause.place);
            if (cause.kind == Kind::rest) rest = 0;
            if (cause.kind == Kind::stage) stages[cause.place] = true;
            if (cause.kind == Kind::setting) settings.set(cause.name, settings_[0].valueOf(cause.name));
            if (cause.kind == Kind::exposure) exposure = 1;
        }
        Image lit = stages_ ? stages_->lit(surfaces(settings, sides), stages) : shade(settings, sides);
        if (!stages_) {
            const Image& added = rest_.at(rest);
            for (std::size_t i = 0; i < lit.data.size(); ++i) lit.data[i] += added.data[i];
        }
        if (exposure != 1)
            for (float& value : lit.data) value *= exposure;
        return lit;
    }

    void share() {
        const int count = static_cast<int>(causes_.size());
        const bool exact = count <= mostExactCauses;
        const std::vector<SubsetWeights> subsets =
            exact ? exactWeights(count) : sampledWeights(count, sampledOrderCount, 1);
        std::vector<std::vector<double>> maps(causes_.size(), std::vector<double>(errors_.size()));
        std::map<Subset, double> values;
        std::vector<double> flip(causes_.size());
        const Subset all = (Subset{1} << count) - 1;
        for (std::size_t s = 0; s < subsets.size(); ++s) {
            progress_.at(static_cast<double>(s) / static_cast<double>(subsets.size()), "swap causes");
            const Image lit = swapped(subsets[s].subset);
            errorsOf(lit, *lit_[0], errors_);
            values[subsets[s].subset] = -meanOf(errors_);
            if (subsets[s].subset == all) {
                found_.unexplained = meanOf(errors_);
                found_.unexplained_map = imageOf(errors_);
            }
            const double felt = hdrFlip(*lit_[0], lit).mean;
            if (subsets[s].subset == 0) found_.flip = felt;
            if (subsets[s].subset == all) found_.flip_unexplained = felt;
            for (std::size_t i = 0; i < flip.size(); ++i) flip[i] -= subsets[s].weight[i] * felt;
            tbb::parallel_for(std::size_t{0}, maps.size(), [&](std::size_t i) {
                const double weight = subsets[s].weight[i];
                for (std::size_t p = 0; p < errors_.size(); ++p) maps[i][p] -= weight * errors_[p];
            });
        }
        const SubsetValue value = [&](Subset subset) { return values.at(subset); };
        const Shares shares =
            exact ? exactShares(count, value) : sampledShares(count, value, sampledOrderCount, 1);
        rank(shares, maps, flip);
    }

    // Of a value a pixel.
    Image imageOf(const std::vector<double>& values) const {
        Image image(lit_[0]->width, lit_[0]->height, 1);
        std::ranges::transform(values, image.data.begin(),
                               [](double value) { return static_cast<float>(value); });
        return image;
    }

    std::vector<MaterialShare> byMaterial(const std::vector<double>& map, double sign) const {
        const Image& ids = channelOf(*frames_[0], idMode);
        std::map<int, double> sums;
        for (std::size_t p = 0; p < map.size(); ++p)
            sums[materialOf(ids.pixel(p), scene_)] += map[p] / static_cast<double>(map.size());
        std::vector<MaterialShare> shares;
        for (const auto& [id, sum] : sums) {
            shares.push_back({id, id >= 0 ? scene_.materials[sizeOf(id)].name : std::string(), sum});
        }
        std::ranges::stable_sort(shares, [sign](const MaterialShare& a, const MaterialShare& b) {
            return sign * a.share > sign * b.share;
        });
        return shares;
    }

    // The places of the lights that are drawn alone, those first that send most. `of`: of a stage of
    // shadows, those that its channel is of: the suns, or points and spots; of these the ones that cast, if
    // any does.
    std::vector<std::size_t> drawnLights(const std::vector<Light>& lights, std::string_view of) {
        const bool suns = of == "shadow_visibility", locals = of == "local_visibility";
        const std::vector<std::size_t> casting =
            castingLights(lights, std::max(settings_[0].shadow_lights, settings_[1].shadow_lights));
        const auto fits = [&](std::size_t place) {
            const bool is_sun = lights[place].kind == LightKind::directional;
            return suns ? is_sun : !locals || !is_sun;
        };
        const bool any_casts = std::ranges::any_of(casting, fits);
        std::vector<std::size_t> places;
        for (std::size_t place = 0; place < lights.size(); ++place)
            if (fits(place) && (!(suns || locals) || !any_casts || std::ranges::count(casting, place) > 0))
                places.push_back(place);
        const auto sends = [&](std::size_t place) {
            const Light& light = lights[place];
            return double{light.intensity} * luminance(glm::dvec3(light.color));
        };
        std::ranges::stable_sort(places, [&](std::size_t a, std::size_t b) { return sends(a) > sends(b); });
        const std::size_t room = mostLightBytes / (2 * 3 * sizeof(float) * errors_.size());
        const std::size_t most = std::clamp<std::size_t>(room, 1, mostLightsDrawn);
        const std::size_t left_out = places.size() - std::min(places.size(), most);
        places.resize(places.size() - left_out);
        found_.lights_drawn = std::max(found_.lights_drawn, places.size());
        found_.lights_left_out = std::max(found_.lights_left_out, left_out);
        return places;
    }

    // What these lights add alone to the test's surfaces under some Settings.
    std::vector<Image> lightsAlone(const Settings& settings, const std::vector<std::size_t>& places,
                                   const LightingStages::Stage* stage) {
        light(settings);
        std::vector<Image> alone;
        for (const std::size_t place : places) {
            const LightChannels adds = shading_->light(~0u, place);
            alone.push_back(stage ? LightingStages::directLight(*stage, adds) : sumOfLobes(adds));
        }
        return alone;
    }

    // Each light's part of a cause's share, where the cause is one of direct light. `map`: the cause's.
    std::vector<LightShare> byLight(const Swapped& cause, const std::vector<double>& map, double sign) {
        const LightingStages::Stage* const stage =
            cause.kind == Kind::stage ? &stages_->stages()[cause.place] : nullptr;
        if (stage ? !stage->lights : cause.kind != Kind::setting || !isOfLights(cause.name)) return {};
        light(settings_[1]);
        const std::vector<Light> lights = shading_->lights();
        const std::vector<std::size_t> places = drawnLights(lights, cause.name);
        if (places.empty()) return {};
        std::vector<std::vector<float>> parts;
        if (stage) {
            Settings lit_by = settings_[1];
            if (*stage->lights == LightChange::seen) lit_by.shadows = Shadows::off;
            const std::vector<Image> alone = lightsAlone(lit_by, places, stage);
            const Image change = LightingStages::directLight(*stage, LightingStages::change(*stage));
            parts = lightsOfChange(change, alone, *stage->lights);
        } else {
            Settings without = settings_[1];
            without.set(cause.name, settings_[0].valueOf(cause.name));
            parts = partsOfDifference(lightsAlone(settings_[1], places, nullptr),
                                      lightsAlone(without, places, nullptr));
        }
        std::vector<LightShare> shares;
        for (std::size_t i = 0; i < places.size(); ++i) {
            double sum = 0;
            for (std::size_t p = 0; p < map.size(); ++p) sum += map[p] * double{parts[i][p]};
            if (sum == 0) continue;
            const Light& of = lights[places[i]];
            shares.push_back({places[i], of.name.empty() ? kindName(of.kind) : of.name,
                              sum / static_cast<double>(map.size())});
        }
        std::ranges::stable_sort(shares, [sign](const LightShare& a, const LightShare& b) {
            return sign * a.share > sign * b.share;
        });
        return shares;
    }

    // Of each light, by how much of all their differences its own is, at each pixel.
    static std::vector<std::vector<float>> partsOfDifference(const std::vector<Image>& a,
                                                             const std::vector<Image>& b) {
        std::vector<std::vector<float>> parts(a.size(), std::vector<float>(a.front().pixels()));
        std::vector<double> apart(parts.front().size()), sums(parts.front().size());
        for (std::size_t i = 0; i < a.size(); ++i) {
            errorsOf(a[i], b[i], apart);
            for (std::size_t p = 0; p < apart.size(); ++p) {
                parts[i][p] = static_cast<float>(apart[p]);
                sums[p] += apart[p];
            }
        }
        for (std::vector<float>& part : parts)
            for (std::size_t p = 0; p < part.size(); ++p)
                if (sums[p] > 0) part[p] = static_cast<float>(double{part[p]} / sums[p]);
        return parts;
    }

    void rank(const Shares& shares, const std::vector<std::vector<double>>& maps,
              const std::vector<double>& flip) {
        std::vector<std::size_t> order(causes_.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(
            order, [&](std::size_t a, std::size_t b) { return shares.share[a] > shares.share[b]; });
        // A Setting that nothing here can feel.
        std::erase_if(order, [&](std::size_t i) {
            const bool felt = shares.share[i] != 0 || shares.alone[i] != 0 || shares.last[i] != 0;
            if (!felt) found_.inert.push_back(nameOfCause(causes_[i]));
            return !felt;
        });
        std::vector<std::size_t> place(causes_.size());
        for (std::size_t k = 0; k < order.size(); ++k) {
            const std::size_t i = order[k];
            place[i] = k;
            // Of a cause that makes up for others, where it does most.
            const double sign = shares.share[i] < 0 ? -1 : 1;
            const auto worst = static_cast<std::size_t>(
                std::ranges::max_element(maps[i], {}, [sign](double at) { return sign * at; }) -
                maps[i].begin());
            const auto width = sizeOf(lit_[0]->width);
            found_.causes.push_back({nameOfCause(causes_[i]), causes_[i].shows, shares.share[i],
                                     shares.interval[i], shares.alone[i], shares.last[i], maps[i][worst],
                                     static_cast<int>(worst % width), static_cast<int>(worst / width),
                                     flip[i], byMaterial(maps[i], sign), byLight(causes_[i], maps[i], sign),
                                     imageOf(maps[i])});
        }
        for (std::size_t p = 0; p < errors_.size(); ++p)
            for (std::size_t k = 0; k < order.size(); ++k) {
                const float dominant = found_.dominant.data[p];
                const double best = dominant < 0 ? 0.0 : maps[order[static_cast<std::size_t>(dominant)]][p];
                if (maps[order[k]][p] > best) found_.dominant.data[p] = static_cast<float>(k);
            }
        if (shares.interaction.empty()) return;
        for (std::size_t j = 1; j < causes_.size(); ++j)
            for (std::size_t i = 0; i < j; ++i) {
                const double both = shares.interaction[i + j * (j - 1) / 2];
                const bool named = std::ranges::count(order, i) > 0 && std::ranges::count(order, j) > 0;
                if (named && std::abs(both) > namedPair * found_.distance)
                    found_.pairs.push_back(
                        {std::min(place[i], place[j]), std::max(place[i], place[j]), both});
            }
        std::ranges::stable_sort(found_.pairs, [](const CausePair& a, const CausePair& b) {
            return std::abs(a.interaction) > std::abs(b.interaction);
        });
    }

    Renderer& renderer_;
    const Scene& scene_;
    const std::array<const Frame*, 2> frames_;  // baseline, test
    std::array<Settings, 2> settings_;          // theirs, as far as what they say is believed
    const Stage progress_;
    SurfaceImages images_;
    std::array<const Image*, 2> lit_;  // the test's without exposure, once that is known
    std::array<Image, 2> own_, rest_;  // our lighting of a side's own channels, and what it leaves
    float exposure_ = 1;               // factor on the test's lit
    Image unexposed_, exposed_;        // the test's lit without it, and with it; where there is any
    std::array<Image, 2> unlike_;      // beyond(): what tells Settings that are not said
    std::vector<Unsaid> unsaid_;       // what the test has without saying so
    std::optional<LightingStages> stages_;
    std::vector<std::size_t> channel_causes_;
    std::vector<Swapped> causes_;
    std::optional<ChannelShading> shading_;
    std::optional<Settings> shaded_settings_;
    Image shaded_;
    std::vector<double> errors_;  // a pixel each
    std::size_t drawn_ = 0;
    Explanation found_;
};

}  // namespace

std::span<const std::string_view> settingsInChannels() {
    return carried;
}

std::vector<int> explainedChannels() {
    std::vector<int> modes(surfaceChannels().begin(), surfaceChannels().end());
    modes.push_back(litMode);
    modes.push_back(idMode);
    std::ranges::sort(modes);
    return modes;
}

Explanation explain(Device& device, Renderer& renderer, const Scene& scene, const Frame& baseline,
                    const Frame& test, const Stage& progress) {
    return Explainer(device, renderer, scene, baseline, test, progress).make();
}

}  // namespace diptych
