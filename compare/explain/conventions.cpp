// SPDX-License-Identifier: MIT
#include "compare/explain/conventions.h"

#include "compare/explain/frame_images.h"
#include "shared/contract/debug_mode.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace diptych {

namespace {

// Values of one option are adjacent.
constexpr std::array knownConventions{
    Convention{"base-layer", "component",
               "a base layer that loses, per component, what its coating reflects"},
    Convention{"spot-cone", "smoothstep", "spot lights with a smoothstep falloff at the cone edge"},
    Convention{"range-window", "squared", "lights with a squared range window"},
    Convention{"multiscatter", "energy", "multiple scattering between microfacets, as a gain of the lobe"},
    Convention{"multiscatter", "fdez", "multiple scattering between microfacets, as a separate lobe"},
};
// The same threshold as for other undeclared Settings (undeclared_settings.cpp).
constexpr double worthHaving = 0.5;

// Surface conventions that another renderer may use without declaring them. At most one change per row is
// accepted.
using SurfaceChange = void (*)(Settings&);
template <SpecularKernel kernel>
void widenRoughness(Settings& s) {
    if (!s.spec_aa) s.spec_aa_kernel = kernel;
    s.spec_aa = true;
}
void turnNormalsOtherwise(Settings& s) {
    s.skin_normals = s.skin_normals == SkinNormals::joints ? SkinNormals::blended : SkinNormals::joints;
}
const std::vector<std::vector<SurfaceChange>> otherSurfaces{
    {turnNormalsOtherwise},
    {widenRoughness<SpecularKernel::variance>, widenRoughness<SpecularKernel::slope>}};

// Renders the view of `plain` with the accepted changes; empty if there are none. A change is accepted if
// it brings lit closer to the other renderer by at least half of its effect, the criterion of
// undeclared_settings.h.
std::optional<Frame> drawnNearer(const Frame& external, const Frame& plain, Renderer& renderer,
                                 const RenderOptions& options) {
    const auto lit = [](const Frame& frame) -> const Image& { return frame.channels.at(Channel::lit); };
    const auto distance = [&](const Frame& a, const Frame& b) { return meanOf(errorsOf(lit(a), lit(b))); };
    // Find the renderer's lighting conventions first: their effect would hide that of the surfaces.
    RenderOptions light = options;
    light.channels = {Channel::lit};
    const ConventionTrial trial{[&](const Settings& settings) { return lit(renderer.draw(settings, light)); },
                                [&](const Image& ours) { return meanOf(errorsOf(ours, lit(external))); }};
    Frame shown =
        renderer.draw(withConventions(plain.settings, nearestConventions(plain.settings, trial)), light);
    Settings surfaces = plain.settings;
    for (const std::vector<SurfaceChange>& changes : otherSurfaces) {
        std::optional<Frame> nearest;
        SurfaceChange believed = nullptr;
        for (const SurfaceChange change : changes) {
            Settings settings = shown.settings;
            change(settings);
            if (settings == shown.settings || settings.problem()) continue;
            Frame tried = renderer.draw(settings, light);
            if (!(distance(tried, external) < distance(nearest ? *nearest : shown, external))) continue;
            nearest = std::move(tried);
            believed = change;
        }
        if (!nearest) continue;
        const double nearer = distance(shown, external) - distance(*nearest, external);
        if (!(nearer > worthHaving * distance(*nearest, shown))) continue;
        believed(surfaces);
        shown = std::move(*nearest);
    }
    if (surfaces == plain.settings) return {};
    // Surface channels do not depend on the lighting conventions.
    return renderer.draw(surfaces, options);
}

}  // namespace

Settings withConventions(Settings said, const std::vector<Convention>& conventions) {
    for (const Convention& each : conventions) said.set(each.option, std::string(each.value));
    return said;
}

std::vector<Convention> nearestConventions(const Settings& said, const ConventionTrial& trial) {
    const Image plain = trial.draw(said);
    std::vector<Convention> effective;
    for (const Convention& each : knownConventions)
        if (said.valueOf(each.option) == Settings().valueOf(each.option) &&
            !sameBits(trial.draw(withConventions(said, {each})), plain))
            effective.push_back(each);
    std::vector<Convention> best;
    Image nearest = plain;
    double min = trial.distance(plain);
    for (std::size_t subset = 1; subset < std::size_t{1} << effective.size(); ++subset) {
        std::vector<Convention> some;
        for (std::size_t i = 0; i < effective.size(); ++i)
            if ((subset >> i & 1) != 0) some.push_back(effective[i]);
        if (std::ranges::adjacent_find(some, {}, &Convention::option) != some.end()) continue;
        Image image = trial.draw(withConventions(said, some));
        const double distance = trial.distance(image);
        if (!(distance < min)) continue;
        min = distance;
        best = std::move(some);
        nearest = std::move(image);
    }
    // Each must be worth its change beside all others; after a removal, all are tested again.
    for (std::size_t i = 0; i < best.size();) {
        std::vector<Convention> others = best;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        Image without = trial.draw(withConventions(said, others));
        const double gained = trial.distance(without) - min;
        if (gained > worthHaving * meanOf(errorsOf(nearest, without))) {
            ++i;
            continue;
        }
        min += gained;
        nearest = std::move(without);
        best = std::move(others);
        i = 0;
    }
    return best;
}

Frame substituteChannels(const Frame& external, const Frame& plain, Renderer& renderer,
                         const RenderOptions& options) {
    const std::optional<Frame> nearer = drawnNearer(external, plain, renderer, options);
    const Frame& ours = nearer ? *nearer : plain;
    Frame frame = external;
    frame.settings = ours.settings;
    frame.requested.clear();
    // Only explained channels: our lighting sums describe our own image.
    for (const Channel channel : options.channels)
        if (const Image* const image = findChannel(ours, channel))
            frame.channels.try_emplace(channel, *image);
    return frame;
}

}  // namespace diptych
