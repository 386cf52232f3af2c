// SPDX-License-Identifier: MIT
#include "compare/report/frame_files.h"

#include "compare/files/frame_exr.h"
#include "compare/files/frame_json.h"
#include "compare/files/our_files.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <stdexcept>

namespace diptych {

namespace {

void writePicture(const std::filesystem::path& file, const Frame& frame, const DebugMode& shown,
                  const PictureChoice& choice) {
    if (!frame.channels.contains(shown.number))
        throw std::runtime_error(
            fmt::format("--debug {}: the {} path does not make it{}", shown.name, frame.name,
                        shown.maker == MadeBy::forward_only ? "; forward_plus does" : ""));
    const auto lit = frame.channels.find(gpu::DEBUG_lit);
    const Exposure exposure =
        exposureFor(choice, lit == frame.channels.end() ? nullptr : &lit->second, coverage(frame, frame));
    const Frame* frames[] = {&frame};
    writePng(file, channelPicture(shown, frame, scaleFor(shown, exposure, frames)));
}

}  // namespace

void writeFrame(const Frame& frame, const ReportDevice& device, const Output& output, const DebugMode& shown,
                const PictureChoice& choice) {
    if (output.kind == OutputKind::exr)
        writeFrameExr(output.path, frame, device);
    else
        writePicture(output.path, frame, shown, choice);
}

std::vector<std::string> writeFrameFolder(const Frame& frame, const ReportDevice& device,
                                          const std::filesystem::path& folder, const DebugMode& shown,
                                          const PictureChoice& choice) {
    const std::vector<std::string> files{frame.name + ".exr", std::string(shown.name) + ".png", "frame.json"};
    writeFrameExr(folder / files[0], frame, device);
    writePicture(folder / files[1], frame, shown, choice);
    const nlohmann::ordered_json json{
        {"schema", 1},
        {"software", softwareName},
        {"device", {{"name", device.name}, {"driver", device.driver}, {"type", device.type}}},
        {"frame", jsonOf(frame)},
        {"files", files}};
    writeFile(folder / files[2],
              json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return files;
}

}  // namespace diptych
