// SPDX-License-Identifier: MIT
#include "compare/report/frame_files.h"

#include "compare/files/diptych_files.h"
#include "compare/files/frame_exr.h"
#include "compare/files/frame_json.h"
#include "compare/image/heat.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/atomic_file.h"
#include "shared/text/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace diptych {

namespace {

void writeImage(const std::filesystem::path& file, const Frame& frame, const DebugMode& selected,
                const ImageChoice& choice) {
    if (!frame.channels.contains(selected.channel))
        throw std::runtime_error(
            fmt::format("--debug {}: the {} path does not have this channel{}", selected.name, frame.name,
                        selected.supported_by == SupportedBy::forward_only    ? "; forward_plus has it"
                        : selected.supported_by == SupportedBy::deferred_only ? "; deferred has it, with MSAA"
                                                                              : ""));
    const Exposure exposure = exposureFor(choice, findChannel(frame, Channel::lit), coverage(frame, frame));
    const Frame* frames[] = {&frame};
    const ImageScale scale = scaleFor(selected, exposure, frames);
    const Image8 image = channelImage(selected, frame, scale);
    writePng(file, isHeat(selected) ? withHeatLegend(image, scale.high) : image);
}

}  // namespace

std::vector<std::filesystem::path> imageFiles(const std::filesystem::path& png,
                                              const ChannelSelection& selected) {
    if (selected.size() == 1) return {png};
    std::vector<std::filesystem::path> files;
    for (const DebugMode* mode : selected) {
        std::filesystem::path file = png;
        files.push_back(file.replace_extension(fmt::format(".{}.png", mode->name)));
    }
    return files;
}

void writeFrame(const Frame& frame, const ReportDevice& device, const Output& output,
                const ChannelSelection& selected, const ImageChoice& choice) {
    if (output.kind == OutputKind::exr) return writeFrameExr(output.path, frame, device);
    const std::vector<std::filesystem::path> files = imageFiles(output.path, selected);
    for (std::size_t i = 0; i < files.size(); ++i) writeImage(files[i], frame, *selected[i], choice);
}

std::vector<std::string> writeFrameFolder(const Frame& frame, const ReportDevice& device,
                                          const std::filesystem::path& folder,
                                          const ChannelSelection& selected, const ImageChoice& choice) {
    std::vector<std::string> files{frame.name + ".exr", "frame.json"};
    writeFrameExr(folder / files[0], frame, device);
    for (const DebugMode* mode : selected) {
        files.push_back(std::string(mode->name) + ".png");
        writeImage(folder / files.back(), frame, *mode, choice);
    }
    const nlohmann::ordered_json json{{"schema", 1},
                                      {"software", softwareName},
                                      {"device", jsonOf(device)},
                                      {"frame", jsonOf(frame)},
                                      {"files", files}};
    writeFile(folder / files[1], jsonText(json) + "\n");
    return files;
}

}  // namespace diptych
