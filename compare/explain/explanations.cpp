// SPDX-License-Identifier: MIT
#include "compare/explain/explanations.h"

#include "compare/explain/conventions.h"
#include "compare/explain/explain.h"
#include "compare/explain/images.h"
#include "compare/explain/write.h"
#include "compare/frames/frame_properties.h"
#include "compare/render/load_scene.h"
#include "compare/render/reference_frame.h"
#include "compare/run/command_text.h"
#include "shared/contract/debug_mode.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace diptych {

using output::Block;

namespace {

bool isWanted(bool all, const Comparison& comparison) {
    return all || std::ranges::any_of(comparison.channels, [](const ChannelDiff& channel) {
               return channel.mode->channel == Channel::lit && channel.verdict == Verdict::fail;
           });
}

// A scene uploaded to the device.
struct ShownScene {
    ShownScene(const Settings& settings, Device& device, const Frame& frame, const Stage& progress)
        : name(frame.scene),
          scene(loadSceneWithSettings(name, settings, progress)),
          views(scene),
          renderer(device, views) {}

    const std::string name;
    const Scene scene;
    SceneViews views;
    Renderer renderer;
};

// A line for a terminal, and blocks for a page.
std::vector<Block> linesOf(const std::string& line, Block page) {
    page.where = Block::page;
    return {{output::List{{line}}, Block::terminal}, std::move(page)};
}

// The part of an explanation that a report shows. `shown`: an image of the scene, of the same size, as
// background of the map of causes.
Explained explainedOf(const Explanation& explanation, const ExplainedImages& of, const Image8& shown) {
    Explained explained{linesOf(headlineOf(explanation), output::Box{"", blocksOf(explanation, of)}),
                        jsonText(toJson(explanation, of), -1),
                        {}};
    if (!explanation.causes.empty()) explained.map = dominantImage(explanation, shown);
    return explained;
}

// The reason why there is no explanation, in one line.
Explained notExplained(const std::string& because) {
    const std::string line = "differences in lit cannot be explained: " + because;
    return {linesOf(line, output::Paragraph{line, "soft"}),
            jsonText(nlohmann::json{{"not_explained", because}}, -1),
            {}};
}

Explained explained(const ExplanationQuestion& question, Device& device, ShownScene& drawing,
                    const Frame& left, const Frame& right, const Stage& progress) {
    const bool file = !left.origin.file.empty(), external = right.origin.external;
    if (file && external)
        throw std::runtime_error("Diptych rendered neither image, so it cannot explain their lighting");
    std::optional<Frame> again[2];
    RenderOptions render = question.drawing;
    render.channels = explainedChannels();
    render.runs = 0;
    const std::uint32_t layers = drawing.views.at(viewRequest((file ? right : left).settings)).needs.layers;
    const auto hasAll = [&](const Frame& frame) {
        return std::ranges::all_of(render.channels, [&](Channel mode) {
            return frame.channels.contains(mode) || !mayShow(mode, layers);
        });
    };
    // Render again if --channels omitted channels.
    if ((!external && !hasAll(right)) || (!file && !hasAll(left))) {
        if (!file) again[0] = drawing.renderer.draw(left.settings, render);
        if (!external) again[1] = drawing.renderer.draw(right.settings, render);
    }
    if (external) again[1] = substituteChannels(right, again[0] ? *again[0] : left, drawing.renderer, render);
    if (file && left.scene.empty()) {
        // Another renderer's file declares no lighting Settings: assume ours.
        again[0] = left;
        again[0]->settings = right.settings;
    }
    const Frame &a = again[0] ? *again[0] : left, &b = again[1] ? *again[1] : right;
    ExplainedImages of{right.scene, left.name, right.name};
    if (!file) {
        std::vector<std::string> words =
            explainArguments(right.scene, external ? left.settings : right.settings, left.settings.path, {});
        words = external ? withOption(std::move(words), "--renderer",
                                      fmt::format("{}={}", right.name, right.origin.file))
                         : withArguments(std::move(words), wordsOf(question.sides));
        of.commands = {{"With a map of each cause",
                        shellLine(withOption(std::move(words), "-o", "diptych-explanation"))}};
    }
    const Explanation explanation = explain(device, drawing.renderer, drawing.scene, a, b, progress);
    return explainedOf(explanation, of, litImage(b, a, question.image));
}

}  // namespace

bool isExplained(bool all, const Report& report) {
    return std::ranges::any_of(report.comparisons, [&](const Comparison& one) { return isWanted(all, one); });
}

void addExplanations(const ExplanationQuestion& question, Device& device, Report& report,
                     const Stage& progress) {
    const auto all = static_cast<double>(report.comparisons.size());
    std::optional<ShownScene> drawing;
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        Comparison& comparison = report.comparisons[i];
        if (!isWanted(question.all, comparison)) continue;
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
                drawing.emplace(question.settings, device, right, stage.part(0, 0.2));
            }
            comparison.explained = explained(question, device, *drawing, left, right, stage.part(0.2, 1));
        } catch (const std::runtime_error& error) {
            comparison.explained = notExplained(error.what());
        }
        letGo(left);
        letGo(right);
    }
    checkValidation(device);
}

std::vector<std::string> explainArguments(const std::string& scene, const Settings& settings, Path baseline,
                                          const std::vector<std::pair<std::string, std::string>>& test) {
    Settings requested = settings;
    requested.path = Settings().path;
    std::vector<std::string> words = commandArguments("explain", scene, requested);
    if (!hasGBuffer(baseline))
        words = withOption(std::move(words), "--baseline", std::string(nameOf(baseline)));
    for (const auto& [option, value] : test)
        words = withOption(std::move(words), "--test", fmt::format("{}={}", option, value));
    return words;
}

}  // namespace diptych
