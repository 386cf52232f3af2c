// SPDX-License-Identifier: MIT
// render --frames: loads and uploads the scene once, and writes each image as soon as it is rendered.
#include "compare/cli/command_render.h"
#include "compare/files/frame_json.h"
#include "compare/files/output_folder.h"
#include "compare/metrics/channel.h"
#include "compare/report/exposure_line.h"
#include "compare/report/titles.h"
#include "compare/run/print.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/atomic_file.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <set>

namespace diptych::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// "0007" for the eighth image. Equal digit counts keep names in the order of the images.
std::string indexSuffix(int frame, int frames) {
    const std::size_t digits = std::max<std::size_t>(4, std::to_string(frames - 1).size());
    return fmt::format("{:0{}}", frame, digits);
}

// "out.exr" becomes "out.0007.exr".
fs::path fileOfFrame(fs::path file, const std::string& suffix) {
    return file.replace_extension(suffix + file.extension().string());
}

// --frames takes one scene and one camera.
void checkOneView(const RenderLine& options) {
    if (options.scenes.size() > 1 || options.cameras.size() > 1)
        refuse("--frames {}: takes one scene and one camera; {} are given", options.frames,
               options.scenes.size() > 1 ? fmt::format("{} scenes", options.scenes.size())
                                         : fmt::format("{} cameras", options.cameras.size()));
}

class FrameWriter {
public:
    FrameWriter(const RenderLine& options, const ReportDevice& made)
        : options_(options),
          made_(made),
          output_(outputIn(options)),
          channels_(selectedChannels(options)),
          image_(imageChoice(options)),
          result_(resultOf(made)) {
        // Fail before rendering if an output cannot be replaced.
        if (output_.kind == OutputKind::folder) {
            checkFolder(output_, 1, options.force);
            folder_.emplace(output_.path);
            return;
        }
        for (int i = 0; i < options.frames; ++i)
            for (const fs::path& file : filesOf(i))
                checkReplaceable({output_.kind, file}, single_manifest, options.force);
    }

    const Output& output() const { return output_; }

    void write(const Frame& frame, int index) {
        if (index == 0) chooseExposure(frame);
        result_["frames"].push_back(jsonOf(frame));
        Json& entry = result_["frames"].back();
        fs::path target;
        if (output_.kind == OutputKind::folder) {
            target = writeInFolder(frame, index, entry);
        } else {
            const std::vector<fs::path> files = filesOf(index);
            const fs::path file = fileOfFrame(output_.path, indexSuffix(index, options_.frames));
            writeFrame(frame, made_, {output_.kind, file}, channels_, image_);
            entry["file"] = file.string();
            if (output_.kind == OutputKind::png)
                for (const fs::path& of : files) entry["files"].push_back(of.string());
            target = files.size() == 1 ? file : file.parent_path() / imageNames(files);
        }
        if (!options_.json && !options_.quiet) print(frame, target, index);
    }

    // Call after the last image: replaces the folder atomically.
    void finish() {
        if (folder_) {
            Json manifest = result_;
            manifest["files"] = files_;
            writeFile(*folder_ / frames_manifest, jsonText(manifest) + "\n");
            files_.emplace_back(frames_manifest);
            folder_->put(files_, [&] { return earlierIn(output_, 1, options_.force); });
        }
        if (options_.json) printOut("{}\n", jsonText(result_));
    }

private:
    // Files of one image. Only for outputs that are not folders.
    std::vector<fs::path> filesOf(int index) const {
        const fs::path file = fileOfFrame(output_.path, indexSuffix(index, options_.frames));
        return output_.kind == OutputKind::png ? imageFiles(file, channels_) : std::vector{file};
    }

    // The first image sets the exposure of all; automatic exposure per image would flicker.
    void chooseExposure(const Frame& first) {
        exposure_line_ = exposureLine(first, image_);
        if (image_.exposure || image_.ev100) return;
        const Image* const lit = findChannel(first, Channel::lit);
        if (output_.kind == OutputKind::exr || !lit) return;
        image_.exposure = exposureFor(image_, lit, coverage(first, first)).factor;
        exposure_line_ += "; chosen from the first image, used for all";
    }

    // Writes FRAME.0007.exr and CHANNEL.0007.png.
    fs::path writeInFolder(const Frame& frame, int index, Json& entry) {
        const std::string ending = indexSuffix(index, options_.frames);
        const std::string exr = fmt::format("{}.{}.exr", frame.name, ending);
        writeFrame(frame, made_, {OutputKind::exr, *folder_ / exr}, channels_, image_);
        files_.push_back(exr);
        for (const DebugMode* mode : channels_) {
            files_.push_back(fmt::format("{}.{}.png", mode->name, ending));
            writeFrame(frame, made_, {OutputKind::png, *folder_ / files_.back()}, {mode}, image_);
        }
        entry["file"] = (output_.path / exr).string();
        return output_.path / exr;
    }

    void print(const Frame& frame, const fs::path& target, int index) {
        const double ms = frame.time.runs > 0 ? frame.time.median : frame.made_in_ms;
        printOut("{}: {} at {:.6g} s, {}x{}, {}{:.2f} ms\n", target.string(), frame.scene,
                 frame.settings.time, frame.settings.size.width, frame.settings.size.height,
                 frame.time.runs > 0 ? "" : "rendered in ", ms);
        if (index == 0 && output_.kind != OutputKind::exr) printOut("  picture: {}\n", exposure_line_);
        for (const std::string& line : frame.notes)
            if (printed_notes_.insert(withoutNumbers(line)).second) printOut("  note: {}\n", line);
        flushText();
    }

    const RenderLine& options_;
    const ReportDevice made_;
    const Output output_;
    const ChannelSelection channels_;
    ImageChoice image_;
    Json result_;
    std::optional<OutputFolder> folder_;
    std::vector<std::string> files_;  // within folder_
    std::string exposure_line_;
    std::set<std::string> printed_notes_;  // printed notes, without their numbers
};

// Renders one Frame at a time from one upload of the scene.
class FrameSource {
public:
    FrameSource(const Scene& scene, Device* device) : views_(scene) {
        if (device) renderer_.emplace(*device, views_);
    }
    Frame draw(const Settings& settings, const RenderOptions& render) {
        Frame frame = renderer_ ? renderer_->draw(settings, render)
                                : std::move(drawWithoutDevice(views_, {settings}, render).front());
        views_.clear();  // no other frame has this time
        return frame;
    }

private:
    SceneViews views_;
    std::optional<Renderer> renderer_;
};

}  // namespace

int runFrames(const RenderLine& options) {
    checkOneView(options);
    Settings settings = settingsOf(options, {options.settings.path}).front();
    checkChannels(options);
    noteIgnored(options);
    Progress progress(progressOutput(options));
    std::optional<Device> device;
    if (needsDevice(settings)) device.emplace(deviceOptions(options));
    const ReportDevice made = reportDeviceOf(device);
    FrameWriter writer(options, made);
    logVerbose(options, "on " + made.name);

    const std::string& name = options.scenes.front();
    RenderOptions render = renderOptions(options);
    render.channels = channelsFor(writer.output().kind, options, render.channels);
    const Stage stage(progress, name);
    const auto frames = static_cast<std::size_t>(options.frames);
    const double loading = loadingFraction(name, render, frames);
    logVerbose(options, name);
    const Scene scene = loadSceneWithSettings(name, options.settings, stage.part(0, loading));
    FrameSource source(scene, device ? &*device : nullptr);
    for (int i = 0; i < options.frames; ++i) {
        settings.time = timeOfFrame(options, i);
        const double each = (1 - loading) / options.frames, begun = loading + each * i;
        const Stage drawing = stage.part(begun, begun + each);
        render.progress = drawing.part(0, drawnFraction(render));
        ReferenceCheckpoints checkpoints(writer.output().path, writer.output().kind == OutputKind::folder);
        render.keep = checkpoints.opener();
        const Frame frame = source.draw(settings, render);
        if (device) checkValidation(*device);
        drawing.at(drawnFraction(render), "write");
        progress.wipe();
        writer.write(frame, i);
        checkpoints.remove();
        if (i + 1 == options.frames) noteLeftByOthers(options, checkpoints);
    }
    progress.wipe();
    writer.finish();
    return 0;
}

}  // namespace diptych::cli
