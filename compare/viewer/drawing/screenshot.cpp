// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/screenshot.h"

#include "compare/frames/frame_properties.h"
#include "compare/report/frame_files.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>

namespace diptych::viewer {

std::string writeScreenshot(PairRenderer& pair, const DrawRequest& request,
                            const std::filesystem::path& folder) {
    pair.views().clear();  // of intermediate cameras
    RenderOptions render = channelOptions(everyChannel());
    render.requested = everyChannel();
    std::filesystem::create_directories(folder);
    std::filesystem::path stem;
    for (int id = 1; stem.empty() || std::filesystem::exists(stem.string() + ".deferred.exr"); ++id)
        stem = folder / fmt::format("diptych-view-{:04}", id);
    const ReportDevice made = reportDevice(*pair.device());
    const DebugMode& mode = debugMode(request.view_options.channel());
    for (const Path path : drawn_paths) {
        const Frame frame =
            pair.renderer().draw(settingsOf(request.subject, path, request.subject.settings.size), render);
        const std::string name = fmt::format("{}.{}", stem.string(), nameOf(path));
        writeFrame(frame, made, {OutputKind::exr, name + ".exr"}, {&mode}, request.view_options.image());
        if (frame.channels.contains(mode.channel))
            writeFrame(frame, made, {OutputKind::png, name + ".png"}, {&mode}, request.view_options.image());
    }
    return stem.string();
}

}  // namespace diptych::viewer
