// SPDX-License-Identifier: MIT
#include "compare/cli/add_option.h"
#include "compare/cli/command.h"
#include "compare/cli/option_groups.h"
#include "compare/experiment/two_devices.h"
#include "compare/explain/conventions.h"
#include "compare/explain/device_contributions.h"
#include "compare/explain/explain.h"
#include "compare/explain/explanations.h"
#include "compare/explain/images.h"
#include "compare/explain/write.h"
#include "compare/external/external_frame.h"
#include "compare/files/frame_exr.h"
#include "compare/output/writers.h"
#include "compare/run/command_text.h"
#include "compare/run/print.h"
#include "compare/run/still_working.h"
#include "shared/image/image_file.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace diptych::cli {

namespace {

struct ExplainLine : SceneGroup, BaselineGroup, RendererGroup {
    std::string scene_file;  // scene of two EXR files; empty: as declared
    // Settings in which the test differs from the baseline, as words of Settings::set().
    std::vector<std::pair<std::string, std::string>> test;
    std::vector<std::string> test_words;
};

void describeExplain(CLI::App& app, ExplainLine& options) {
    addScene(app, options, "a glTF file or builtin:NAME (builtin:gallery); or two EXR files");
    addAgainst(app, options, "render the baseline's path on this device too, and explain the difference");
    addSides(app, options);
    addFiles(app, options, "folder for the page, maps and JSON; without -o: no files");
    addBaseline(app, options, "picture taken as correct (deferred)", "deferred|forward_plus");
    addRenderers(app, options, "another renderer as the second picture");
    addOption(app, "--scene", options.scene_file, "FILE", "scene of two EXR files, if they do not name it");
    addEach(app, "--test", options.test_words, "NAME=VALUE",
            "Setting of the second picture, such as gbuffer=compact; repeatable (path: the other path)");
    addOutput(app, options);
    acceptUnread(app, {"--debug", "--heat", "--channels", "--list-channels", "--path", "--runs"});
}

void resolveExplain(ExplainLine& options) {
    resolveScene(options);
    resolveBaseline(options);
    for (const std::string& requested : options.test_words) {
        const std::size_t at = requested.find('=');
        if (at == std::string::npos || at == 0)
            refuse("--test {}: takes NAME=VALUE, for example gbuffer=compact", requested);
        const std::string name = requested.substr(0, at);
        if (std::ranges::none_of(settingFields(), [&](const Field& field) { return field.option == name; }))
            refuse("--test {}: there is no Setting {}", requested, name);
        options.test.emplace_back(name, requested.substr(at + 1));
    }
    resolveRenderers(options);
}

// The test Settings: those of --test, else the other path.
Settings testOf(const ExplainLine& options, const Settings& baseline, std::string& name) {
    if (!options.test.empty() && options.sides.any())
        refuse("--test: --deferred and --forward-plus already define both images; leave out --test");
    const Path other = otherPath(options.baseline);
    Settings test = options.sides.of(options.settings, options.test.empty() ? other : options.baseline);
    for (const SettingDifference& of : settingDifferences(baseline, test))
        name += fmt::format(" --{} {}", of.option, of.test);
    for (const auto& [option, value] : options.test) {
        if (std::ranges::find(viewOptions(), std::string_view(option)) != viewOptions().end())
            refuse("--test {0}={1}: both images show one view of one scene; give --{0} {1} instead", option,
                   value);
        test.set(option, value);
        if (option != "path") name += fmt::format(" --{} {}", option, value);
    }
    name = fmt::format("{}{}", nameOf(test.path), name);
    if (isReference(test.path))
        refuse(
            "--test path=reference: explain works with the two rendered paths; use deferred or forward_plus");
    if (test == baseline) refuse("--test: both images have the same Settings; give one that differs");
    checkSettings(test);
    return test;
}

// Prints the explanation, and writes it if -o is given.
void leave(const ExplainLine& options, const ImageChoice& image, const Explanation& explanation,
           const ExplainedImages& of, const Frame& baseline, const Frame& test) {
    std::string json;
    if (!options.out.empty())
        json = writeExplanation(explanation, of,
                                {litImage(baseline, baseline, image), litImage(test, baseline, image)},
                                options.out, options.force);
    wipeProgress();
    if (options.json) {
        printOut("{}", json.empty() ? jsonText(toJson(explanation, of)) + "\n" : json);
    } else if (!options.quiet) {
        printColored(options, inText(blocksOf(explanation, of)));
        if (!options.out.empty()) printOut("page: {}\n", (options.out / "index.html").string());
    }
}

// The view of `own`, rendered by the only --renderer.
Frame drawnByOther(const ExplainLine& options, SceneViews& views, const Frame& own, Renderer& drawing,
                   const RenderOptions& render) {
    const external::ExternalRenderer& renderer = options.renderers.front();
    external::Attempt attempt =
        external::drawExternally(renderer, views.scene(), views.at(viewRequest(own.settings)), own.settings);
    if (!attempt.frame)
        refuse("renderer {} ({}): {}", renderer.name, renderer.file.string(), attempt.problem);
    for (const std::string& line : attempt.frame->notes)
        if (std::ranges::count(own.notes, line) == 0) note(options, line);
    return substituteChannels(*attempt.frame, own, drawing, render);
}

// Checks the options of one scene. Returns the baseline's Settings.
Settings checkedBaseline(const ExplainLine& options) {
    if (options.scenes.size() != 1)
        refuse("{}: explain takes one scene; run it once for each", options.scenes[1]);
    if (!options.scene_file.empty())
        refuse("--scene {}: names the scene of two EXR files; the scene here is {}", options.scene_file,
               options.scenes.front());
    const Settings baseline = options.sides.of(options.settings, options.baseline);
    checkSettings(baseline);
    const bool external = !options.renderers.empty();
    if (external && (options.renderers.size() > 1 || !options.test.empty()))
        refuse("--renderer: explain compares two images; give one renderer and no --test");
    if (options.against_device.empty()) return baseline;
    if (external || !options.test.empty())
        refuse("--against-device {}: explain compares two images; give no --renderer and no --test",
               options.against_device);
    checkOneSample(options, {baseline});
    return baseline;
}

void addCommands(const ExplainLine& options, const Settings& baseline, const Settings& test,
                 ExplainedImages& of) {
    const bool external = !options.renderers.empty(), across = !options.against_device.empty();
    std::vector<std::string> again = withArguments(
        withArguments(explainArguments(of.scene, options.settings, options.baseline, options.test),
                      options.renderer_texts),
        wordsOf(options.sides));
    if (across)
        again = withOption(withOption(std::move(again), "--against-device", options.against_device),
                           "--device", options.device.empty() ? "0" : options.device);
    of.commands = {{"Explain it again", shellLine(again)},
                   {"The baseline alone", commandOf("render", of.scene, baseline)}};
    if (!external && !across) of.commands.push_back({"The test alone", commandOf("render", of.scene, test)});
    if (options.test.empty() && !external)
        of.commands.push_back(
            {"Every channel of both", shellLine(withArguments(commandArguments("compare", of.scene, baseline),
                                                              wordsOf(options.sides)))});
}

int explainScene(const ExplainLine& options) {
    const Settings baseline = checkedBaseline(options);
    ExplainedImages of{options.scenes.front(), std::string(nameOf(options.baseline)), ""};
    const bool external = !options.renderers.empty();
    const Settings test =
        external || !options.against_device.empty() ? baseline : testOf(options, baseline, of.test);
    if (external) of.test = options.renderers.front().name;
    addCommands(options, baseline, test, of);
    const ImageChoice image = imageChoice(options);
    Progress progress(progressOutput(options));
    const Stage stage(progress, of.scene);
    const Scene scene = loadSceneWithSettings(of.scene, options.settings, stage.part(0, 0.1));
    Device device(deviceOptions(options));
    of.device = device.info().name;
    const std::unique_ptr<Device> other = againstDevice(options);
    logVerbose(options, "on " + of.device + (other ? " and " + other->info().name : ""));
    SceneViews views(scene);
    Renderer renderer(device, views);
    RenderOptions drawing = renderOptions(options);
    drawing.channels = explainedChannels();
    if (other)
        for (const Channel channel : deviceContributionChannels())
            if (std::ranges::count(drawing.channels, channel) == 0) drawing.channels.push_back(channel);
    drawing.runs = 0;
    drawing.progress = stage.part(0.1, 0.25);
    const Frame a = renderer.draw(baseline, drawing);
    drawing.progress = stage.part(0.25, 0.4);
    const Frame b = external ? drawnByOther(options, views, a, renderer, drawing)
                    : other  ? Renderer(*other, views).draw(test, drawing)
                             : renderer.draw(test, drawing);
    if (other)
        of.baseline += " on " + of.device,
            of.test = fmt::format("{} on {}", nameOf(test.path), other->info().name);
    Explanation explanation = explain(device, renderer, scene, a, b, stage.part(0.4, 1));
    if (other) {
        explanation.devices =
            deviceContributions(explanation, a, b,
                                experiment::acrossDevices(
                                    scene, views.at(viewRequest(a.settings)),
                                    precisionsOf(device, *other, !scene.textures.empty(), test.textures), a));
        checkValidation(*other);
    }
    checkValidation(device);
    leave(options, image, explanation, of, a, b);
    return 0;
}

bool isExr(const std::string& name) {
    const auto ending = imageName(name).file.extension();
    return ending == ".exr" || ending == ".EXR";
}

// Reads an EXR. Settings that it does not declare come from the command line.
Frame readImage(const ExplainLine& options, const std::string& file) {
    Frame frame = frameFromExr(file);
    frame.name = file;
    if (frame.scene.empty()) {
        frame.settings = options.settings;
        frame.settings.camera = options.cameras.front();
    } else {
        checkAsked(file, options.scene_file.empty() ? frame.scene : "", frame.settings);
    }
    if (isReferenceFrame(frame))
        refuse(
            "{}: is an image of the reference, which does not light from the channels that explain replaces; "
            "give images of deferred or forward_plus",
            file);
    if (isReference(frame.settings.path)) frame.settings.path = unencoded_path;  // from another renderer
    const Image& any = frame.channels.begin()->second;
    frame.settings.size = {any.width, any.height};
    return frame;
}

int explainFiles(const ExplainLine& options) {
    Progress progress(progressOutput(options));
    std::optional<StillWorking> working(std::in_place, Stage(progress, options.scenes[1]).part(0, 0), "read");
    const Frame a = readImage(options, options.scenes[0]), b = readImage(options, options.scenes[1]);
    working.reset();
    if (options.scene_file.empty() && !a.scene.empty() && !b.scene.empty() && a.scene != b.scene)
        refuse(
            "{} shows {}, {} shows {}: explain takes one scene; if both are the same scene, give --scene "
            "FILE",
            options.scenes[0], a.scene, options.scenes[1], b.scene);
    for (int i = 0; i < 3 && !a.scene.empty() && !b.scene.empty(); ++i)
        if (std::abs(a.camera.eye[i] - b.camera.eye[i]) > 1e-6 * (1 + std::abs(a.camera.eye[i])))
            refuse("{} and {} have different camera positions; explain needs two images of one view",
                   options.scenes[0], options.scenes[1]);
    if (!a.scene.empty() && !(options.settings == Settings()))
        note(options, "Settings come from the files; those of the command line are not used");
    std::string where = options.scene_file;
    for (const Frame* frame : {&a, &b})
        if (where.empty()) where = frame->scene;
    if (where.empty())
        refuse("{}, {}: neither file names its scene; give --scene FILE", options.scenes[0],
               options.scenes[1]);
    std::vector<std::string> words{"explain", options.scenes[0], options.scenes[1]};
    if (!options.scene_file.empty()) words = withOption(std::move(words), "--scene", options.scene_file);
    ExplainedImages of{
        where,
        options.scenes[0],
        options.scenes[1],
        {{"Explain it again", shellLine(words)},
         {"Every channel of both", shellLine({"diff", options.scenes[0], options.scenes[1]})}}};
    const ImageChoice image = imageChoice(options);
    const Stage stage(progress, where);
    const Scene scene = loadSceneWithSettings(where, a.settings, stage.part(0, 0.3));
    Device device(deviceOptions(options));
    of.device = device.info().name;
    logVerbose(options, "on " + of.device);
    SceneViews views(scene);
    Renderer renderer(device, views);
    const Explanation explanation = explain(device, renderer, scene, a, b, stage.part(0.3, 1));
    checkValidation(device);
    leave(options, image, explanation, of, a, b);
    return 0;
}

int runExplain(const ExplainLine& options) {
    if (!options.out.empty()) outputFolder(options, "", "explanation", explanationManifest);
    if (options.cameras.size() != 1)
        refuse("--camera {}: explain takes one view; run it once for each", options.cameras[1]);
    if (isReference(options.baseline) || !options.baseline_file.empty())
        refuse(
            "--baseline reference or FILE.exr: explain works with the two rendered paths; use "
            "deferred or forward_plus");
    if (std::ranges::none_of(options.scenes, isExr)) return explainScene(options);
    if (options.scenes.size() != 2 || !std::ranges::all_of(options.scenes, isExr))
        refuse("{}: explain takes one scene or two EXR files", options.scenes.front());
    if (!options.test.empty())
        refuse("--test {}={}: the two files define both images; leave out --test", options.test[0].first,
               options.test[0].second);
    return explainFiles(options);
}

}  // namespace

Command explainCommand() {
    return makeCommand<ExplainLine>(
        {"explain",
         "Ranks the causes of a lit difference: which channels and Settings, by how much, and where",
         "diptych explain helmet.glb --gbuffer compact -o helmet-causes",
         "gbuffer test baseline scene lights camera size device out json"},
        describeExplain, resolveExplain, runExplain);
}

}  // namespace diptych::cli
