// SPDX-License-Identifier: MIT
#include "compare/explain/undeclared_settings.h"

#include "compare/explain/conventions.h"
#include "compare/explain/frame_images.h"
#include "compare/explain/lighting_components.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace diptych {

namespace {

// If the test's lit does not match its Settings, others are tried: an environment rotated by further
// degrees, as by exchanged axes; environment light, ambient light or haze scaled or removed. A Setting is
// accepted if it brings lit nearer by at least half of its change. A multiple that no term confirms must
// also leave less than half of the residual. At most maxBelieved are accepted.
constexpr std::array triedRotations{90.0f, 180.0f, 270.0f};
constexpr double believedRest = 0.5;
constexpr int maxBelieved = 3;
constexpr double minBrighter = 0.01;

// Whether an image is from another renderer: its Settings are the request, not necessarily what it does.
bool isForeign(const Frame& frame) {
    return frame.origin.external || (!frame.origin.file.empty() && frame.origin.commit.empty());
}

class UndeclaredSearch {
public:
    UndeclaredSearch(const ExplainedSides& sides, ChannelLighting& lighting)
        : sides_(sides), lighting_(lighting), said_(sides.settings(1)) {}

    std::vector<UndeclaredSetting> find() {
        beyond_ = {beyond(comparable(sides_.settings(0), 0), 0), beyond(comparable(said_, 1), 1)};
        if (sameBits(beyond_[0], beyond_[1])) return {};
        if (isForeign(sides_.frame(1))) findConventions();
        double left = meanOf(errorsOf(beyond_[1], beyond_[0]));
        for (int believed = 0; believed < maxBelieved && left > 0; ++believed) {
            double min = left;
            std::optional<UndeclaredSetting> best;
            const Image said = comparable(said_, 1);
            for (UndeclaredSetting& tried : triedSettings()) {
                const Image ours = comparable(tried.settings, 1);
                // A true change of ambient light also affects the haze.
                if (tried.option == "ambient" && said_.haze && !bringsHazeNearer(tried.settings)) continue;
                const double changed = meanOf(errorsOf(ours, said));
                const double residual = distance(ours);
                if (!(residual < min) || !(left - residual > believedRest * changed) ||
                    (tried.guessed && !(residual < believedRest * left)))
                    continue;
                min = residual;
                best = std::move(tried);
            }
            if (!best) break;
            left = min;
            said_ = best->settings;
            beyond_[1] = beyond(comparable(said_, 1), 1);
            found_.push_back(std::move(*best));
        }
        return std::move(found_);
    }

private:
    void findConventions() {
        const ConventionTrial trial{[&](const Settings& settings) { return comparable(settings, 1); },
                                    [&](const Image& ours) { return distance(ours); }};
        for (const Convention& each : nearestConventions(said_, trial)) {
            said_ = withConventions(said_, {each});
            found_.push_back({each.option, said_, std::string(each.description)});
        }
        beyond_[1] = beyond(comparable(said_, 1), 1);
    }

    std::vector<UndeclaredSetting> triedSettings() {
        std::vector<UndeclaredSetting> all;
        const auto tryIt = [&](std::string_view option, std::string description, bool guessed,
                               const auto& change) {
            if (std::ranges::count(found_, option, &UndeclaredSetting::option) > 0) return;
            all.push_back({option, said_, std::move(description), guessed});
            change(all.back().settings);
        };
        const bool lit_around = said_.env != Settings().env && said_.ibl_intensity > 0;
        for (const float degrees : triedRotations)
            if (lit_around)
                tryIt(
                    "env-rotation",
                    fmt::format("an environment rotated by {} degrees more than the test's Settings declare",
                                degrees),
                    false, [&](Settings& s) { s.env_rotation += degrees; });
        const auto multiple = [](const char* what, double factor) {
            return fmt::format("{} of {:.4g} times the value in the test's Settings", what, factor);
        };
        const TermFactors factors = factorsOfTerms();
        const auto brighter = [&](std::string_view option, const char* what, std::optional<double> known,
                                  const auto& change) {
            Settings none = said_;
            change(none, 0.0f);
            const double factor = known ? *known : brightness(none);
            if (std::abs(factor - 1) > minBrighter)
                tryIt(option, multiple(what, factor), !known,
                      [&](Settings& s) { change(s, static_cast<float>(factor)); });
        };
        const bool ambient = said_.ambient.r > 0 || said_.ambient.g > 0 || said_.ambient.b > 0;
        if (ambient && (!factors.known || factors.ambient))
            brighter("ambient", "ambient light", factors.ambient, [](Settings& s, float by) {
                s.ambient = {by * s.ambient.r, by * s.ambient.g, by * s.ambient.b};
            });
        if (lit_around)
            brighter("ibl-intensity", "light of the environment", {},
                     [](Settings& s, float by) { s.ibl_intensity *= by; });
        if (said_.haze && (!factors.known || factors.no_haze))
            tryIt("haze", "no haze, although the test's Settings enable it", !factors.known,
                  [](Settings& s) { s.haze = false; });
        if (said_.haze && factors.haze)
            tryIt("haze-density", multiple("density", *factors.haze), false,
                  [&](Settings& s) { s.haze_density *= static_cast<float>(*factors.haze); });
        return all;
    }

    // The factor of the light that is missing under these Settings: 1 plus the median of the residual, as
    // a multiple of that light's contribution.
    double brightness(const Settings& without) {
        const Image with = comparable(said_, 1), none = comparable(without, 1);
        std::vector<double> adds(with.data.size());
        double sum = 0;
        for (std::size_t i = 0; i < adds.size(); ++i) {
            adds[i] = double{with.data[i]} - none.data[i];
            if (std::isfinite(adds[i])) sum += std::abs(adds[i]);
        }
        const double min = 1e-3 * sum / static_cast<double>(adds.size());
        std::vector<double> ratios;
        for (std::size_t i = 0; i < adds.size(); ++i) {
            const double missing =
                double{std::as_const(beyond_[1]).data[i]} - std::as_const(beyond_[0]).data[i];
            if (adds[i] > min && std::isfinite(missing)) ratios.push_back(missing / adds[i]);
        }
        if (ratios.empty()) return 1;
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::ranges::nth_element(ratios, middle);
        const double factor = 1 + *middle;
        return factor < minBrighter ? 0.0 : factor;
    }

    // Ratios of the test's terms to ours, if they are equal everywhere.
    struct TermFactors {
        bool known = false;  // there are terms
        bool no_haze = false;
        std::optional<double> ambient{}, haze{};  // other than 1; haze: its density
    };
    TermFactors factorsOfTerms() {
        if (!sides_.haveTerms()) return {};
        const ChannelTerms terms = lighting_.under(said_).terms(allChannelsOf(1));
        const auto theirs = [&](Channel channel) -> const Image& {
            return channelOf(sides_.frame(1), channel);
        };
        const Image& ids = theirs(Channel::material_id);
        Image depth = theirs(Channel::transmittance), our_depth = terms.transmittance;
        bool hazy = false, dark = true;
        for (std::size_t i = 0; i < depth.data.size(); ++i) {
            const bool surface = ids.pixel(i / 3)[0] >= 0;
            // Density is proportional to the logarithm of the transmittance.
            depth.data[i] = surface ? -std::log(depth.data[i]) : 0;
            our_depth.data[i] = surface ? -std::log(our_depth.data[i]) : 0;
            hazy = hazy || depth.data[i] != 0 || theirs(Channel::lit_haze).data[i] != 0;
            dark = dark && theirs(Channel::lit_ambient).data[i] == 0;
        }
        return {true, !hazy,
                dark ? std::optional(0.0)
                     : exposureBetween(1.0, commonFactor(theirs(Channel::lit_ambient), terms.ambient)),
                exposureBetween(1.0, commonFactor(depth, our_depth))};
    }

    // The image for comparing undeclared Settings: the sum of our terms for a side's surfaces if both
    // sides have terms, so that later operations do not matter; else our lit.
    Image comparable(const Settings& settings, std::size_t side) {
        if (!sides_.haveTerms()) return lighting_.lit(settings, allChannelsOf(side));
        return sumOfTerms(lighting_.under(settings).terms(allChannelsOf(side)),
                          channelOf(sides_.frame(side), Channel::emission));
    }
    // A side's residual beyond that image.
    Image beyond(const Image& ours, std::size_t side) const {
        return differenceOf(sides_.haveTerms() ? sumOfTerms(sides_.frame(side)) : sides_.lit(side), ours);
    }
    // How far the test's residual beyond that image is from the baseline's.
    double distance(const Image& ours) const { return meanOf(errorsOf(beyond(ours, 1), beyond_[0])); }
    bool bringsHazeNearer(const Settings& tried) {
        if (!sides_.haveTerms()) return true;
        const Image& theirs = channelOf(sides_.frame(1), Channel::lit_haze);
        const auto off = [&](const Settings& settings) {
            return meanOf(errorsOf(lighting_.under(settings).terms(allChannelsOf(1)).haze, theirs));
        };
        return off(tried) <= off(said_);
    }

    const ExplainedSides& sides_;
    ChannelLighting& lighting_;
    Settings said_;                // the test's, with the accepted ones
    std::array<Image, 2> beyond_;  // beyond() under each side's Settings
    std::vector<UndeclaredSetting> found_;
};

}  // namespace

std::vector<UndeclaredSetting> undeclaredSettings(const ExplainedSides& sides, ChannelLighting& lighting) {
    if (!sides.residualName().empty() || !sides.residualsDiffer()) return {};
    return UndeclaredSearch(sides, lighting).find();
}

}  // namespace diptych
