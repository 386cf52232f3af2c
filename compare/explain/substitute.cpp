// SPDX-License-Identifier: MIT
#include "compare/explain/substitute.h"

#include "compare/explain/conventions.h"
#include "compare/explain/explain.h"
#include "compare/explain/frame_images.h"
#include "shared/contract/debug_mode.h"

#include <optional>
#include <utility>
#include <vector>

namespace diptych {

namespace {

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
        if (!(nearer > 0.5 * distance(*nearest, shown))) continue;
        believed(surfaces);
        shown = std::move(*nearest);
    }
    if (surfaces == plain.settings) return {};
    // Surface channels do not depend on the lighting conventions.
    return renderer.draw(surfaces, options);
}

}  // namespace

Frame substituteChannels(const Frame& external, const Frame& plain, Renderer& renderer,
                         const RenderOptions& options) {
    const std::optional<Frame> nearer = drawnNearer(external, plain, renderer, options);
    const Frame& ours = nearer ? *nearer : plain;
    Frame frame = external;
    frame.settings = ours.settings;
    frame.requested.clear();
    // Only explained channels: our lighting sums describe our own image.
    for (const Channel mode : explainedChannels())
        if (const auto found = ours.channels.find(mode); found != ours.channels.end())
            frame.channels.try_emplace(mode, found->second);
    return frame;
}

}  // namespace diptych
