// SPDX-License-Identifier: MIT
#include "compare/cli/explanations.h"

#include "compare/cli/commands.h"
#include "compare/explain/conventions.h"
#include "compare/explain/explain.h"
#include "compare/explain/explained.h"
#include "compare/explain/frame_images.h"
#include "compare/explain/write.h"
#include "compare/run/command_text.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace diptych::cli {

namespace {

bool isWanted(const Options& options, const Comparison& comparison) {
    return options.explain || std::ranges::any_of(comparison.channels, [](const ChannelDiff& channel) {
               return channel.mode->number == static_cast<int>(gpu::DEBUG_lit) &&
                      channel.verdict == Verdict::fail;
           });
}

// A scene uploaded to the device.
struct Drawing {
    Drawing(const Options& options, Device& device, const Frame& frame, const Stage& progress)
        : name(frame.scene),
          scene(loadShown(name, options.settings, progress)),
          views(scene),
          renderer(device, views) {}

    const std::string name;
    const Scene scene;
    SceneViews views;
    Renderer renderer;
};

// `layers`: those of the scene (Requirements::layers); the channels of others are not needed.
bool hasAll(const Frame& frame, const std::vector<int>& channels, std::uint32_t layers) {
    return std::ranges::all_of(channels, [&](int mode) {
        return frame.channels.contains(mode) || (layerOf(mode) != 0 && (layers & layerOf(mode)) == 0);
    });
}

// Another renderer's file declares no lighting Settings: assume ours.
Frame asOurs(const Frame& file, const Frame& drawn) {
    Frame frame = file;
    frame.settings = drawn.settings;
    return frame;
}

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
    const auto lit = [](const Frame& frame) -> const Image& {
        return frame.channels.at(static_cast<int>(gpu::DEBUG_lit));
    };
    const auto distance = [&](const Frame& a, const Frame& b) { return meanOf(errorsOf(lit(a), lit(b))); };
    // Find the renderer's lighting conventions first: their effect would hide that of the surfaces.
    RenderOptions light = options;
    light.channels = {static_cast<int>(gpu::DEBUG_lit)};
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

Explained explained(const Options& options, Device& device, Drawing& drawing, const Frame& left,
                    const Frame& right, const Stage& progress) {
    const std::vector<int> channels = explainedChannels();
    const bool file = !left.origin.file.empty(), external = right.origin.external;
    if (file && external)
        throw std::runtime_error("Diptych rendered neither image, so it cannot explain their lighting");
    // Render again if --channels omitted channels.
    std::optional<Frame> again[2];
    RenderOptions render = renderOptions(options);
    render.channels = channels;
    render.runs = 0;
    const std::uint32_t layers = drawing.views.at(viewRequest((file ? right : left).settings)).needs.layers;
    if ((!external && !hasAll(right, channels, layers)) || (!file && !hasAll(left, channels, layers))) {
        if (!file) again[0] = drawing.renderer.draw(left.settings, render);
        if (!external) again[1] = drawing.renderer.draw(right.settings, render);
    }
    if (external) again[1] = substituteChannels(right, again[0] ? *again[0] : left, drawing.renderer, render);
    if (file && left.scene.empty()) again[0] = asOurs(left, right);
    const Frame &a = again[0] ? *again[0] : left, &b = again[1] ? *again[1] : right;
    ExplainedPictures of{right.scene, left.name, right.name};
    if (!file) {
        std::vector<std::string> words =
            explainWords(right.scene, external ? left.settings : right.settings, left.settings.path, {});
        if (!external) words = withWords(std::move(words), wordsOf(options.sides));
        if (external)
            words = withOption(std::move(words), "--renderer",
                               fmt::format("{}={}", right.name, right.origin.file));
        of.commands = {{"With a map of each cause",
                        shellLine(withOption(std::move(words), "-o", "diptych-explanation"))}};
    }
    const Explanation explanation = explain(device, drawing.renderer, drawing.scene, a, b, progress);
    return explainedOf(explanation, of, litPicture(b, a, options.picture));
}

}  // namespace

bool isExplained(const Options& options, const Report& report) {
    return std::ranges::any_of(report.comparisons,
                               [&](const Comparison& one) { return isWanted(options, one); });
}

void addExplanations(const Options& options, Device& device, Report& report, const Stage& progress) {
    const auto all = static_cast<double>(report.comparisons.size());
    std::optional<Drawing> drawing;
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        Comparison& comparison = report.comparisons[i];
        if (!isWanted(options, comparison)) continue;
        const Frame &left = report.baseline(comparison), &right = report.test(comparison);
        if (isReferenceFrame(left)) {
            comparison.explained = notExplained(
                "the reference does not light from the channels that explain replaces; the comparison of "
                "both paths is explained");
            continue;
        }
        const auto done = static_cast<double>(i);
        const Stage stage = progress.part(done / all, (done + 1) / all).about(right.scene);
        try {
            if (!drawing || drawing->name != right.scene) {
                drawing.reset();
                drawing.emplace(options, device, right, stage.part(0, 0.2));
            }
            comparison.explained = explained(options, device, *drawing, left, right, stage.part(0.2, 1));
        } catch (const std::runtime_error& error) {
            comparison.explained = notExplained(error.what());
        }
        letGo(left);
        letGo(right);
    }
    checkValidation(device);
}

Frame substituteChannels(const Frame& external, const Frame& plain, Renderer& renderer,
                         const RenderOptions& options) {
    const std::optional<Frame> nearer = drawnNearer(external, plain, renderer, options);
    const Frame& ours = nearer ? *nearer : plain;
    Frame frame = external;
    frame.settings = ours.settings;
    frame.requested.clear();
    // Only explained channels: our lighting sums describe our own image.
    for (const int mode : explainedChannels())
        if (const auto found = ours.channels.find(mode); found != ours.channels.end())
            frame.channels.try_emplace(mode, found->second);
    return frame;
}

std::vector<std::string> explainWords(const std::string& scene, const Settings& settings, Path baseline,
                                      const std::vector<std::pair<std::string, std::string>>& test) {
    Settings given = settings;
    given.path = Settings().path;
    std::vector<std::string> words = commandWords("explain", scene, given);
    if (!hasGBuffer(baseline))
        words = withOption(std::move(words), "--baseline", std::string(nameOf(baseline)));
    for (const auto& [option, value] : test)
        words = withOption(std::move(words), "--test", fmt::format("{}={}", option, value));
    return words;
}

}  // namespace diptych::cli
