// SPDX-License-Identifier: MIT
#include "compare/files/frame_exr.h"

#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/files/layers.h"
#include "compare/run/version.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/exr.h"
#include "shared/image/image_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace diptych {
namespace {

using Attributes = std::map<std::string, std::string>;

std::string valueOr(const Attributes& attributes, const char* key, const char* fallback = "") {
    const auto found = attributes.find(key);
    return found == attributes.end() ? fallback : oneLine(found->second);
}

// Metadata of our own files.
void readOrigin(const ImageFile& file, Frame& frame) {
    const Attributes& a = file.attributes;
    frame.scene = valueOr(a, "scene", "?");
    frame.origin.device = valueOr(a, "device");
    frame.origin.driver = valueOr(a, "driver");
    frame.origin.commit = valueOr(a, "commit");
    frame.settings = settingsFromJson(a.at("settings"));
    if (a.contains("camera"))
        frame.camera = cameraFrom(JsonAt<nlohmann::json>(parseJson(a.at("camera")), "camera"));
}

bool isOurs(const ImageFile& file) {
    return valueOr(file.attributes, "software") == softwareName && file.attributes.contains("settings");
}

// Uncertainty of a sampled reference, as written.
void readUncertainty(ImageFile& file, Frame& frame) {
    frame.uncertainty = takeUncertainty(file);
    if (frame.uncertainty.empty()) return;
    const std::string relative = valueOr(file.attributes, "relative_uncertainty");
    const char* const end = relative.data() + relative.size();
    const auto read = std::from_chars(relative.data(), end, frame.relative_uncertainty);
    if (read.ec != std::errc{} || read.ptr != end)
        throw std::runtime_error(
            fmt::format("attribute relative_uncertainty \"{}\" is not a number", relative));
    frame.notes.push_back(uncertaintyNote(frame.relative_uncertainty));
}

}  // namespace

void writeFrameExr(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device) {
    std::vector<ExrLayerView> layers;
    for (const auto& [mode, image] : frame.channels)
        if (frame.isRequested(mode)) layers.push_back({exrChannels(debugMode(mode)), &image});
    std::vector<ExrAttribute> attributes{{"camera", jsonOf(frame.camera).dump()},
                                         {"commit", commitName()},
                                         {"device", device.name},
                                         {"driver", device.driver},
                                         {"scene", frame.scene},
                                         {"settings", toJson(frame.settings, -1)},
                                         {"software", softwareName}};
    if (!frame.uncertainty.empty() && frame.channels.contains(Channel::lit) &&
        frame.isRequested(Channel::lit)) {
        layers.push_back({{uncertainty_channel}, &frame.uncertainty});
        attributes.push_back({"relative_uncertainty", fmt::format("{}", frame.relative_uncertainty)});
    }
    writeExr(file, layers, attributes);
}

Frame frameFromExr(const std::filesystem::path& path) {
    ImageFile file = readImage(path);
    return named(path.string(), [&] {
        Frame frame;
        frame.name = "baseline";
        frame.origin.file = path.string();
        if (isOurs(file))
            readOrigin(file, frame);
        else
            frame.settings.path = Path::reference;
        if (isReferenceFrame(frame)) readUncertainty(file, frame);
        frame.settings.size = {file.width, file.height};
        frame.notes.insert(frame.notes.end(), file.notes.lines.begin(), file.notes.lines.end());
        frame.origin.not_applied = file.notes.not_applied;
        frame.origin.not_applied.insert(frame.origin.not_applied.end(), file.notes.in_part.begin(),
                                        file.notes.in_part.end());
        for (ImageChannel& channel : channelsOf(std::move(file), {})) {
            const DebugMode* mode = findDebugMode(channel.name);
            if (mode && mode->name == channel.name && mode->width == channel.image.components)
                frame.channels[mode->channel] = std::move(channel.image);
            else
                frame.origin.omitted_channels.push_back(oneLine(channel.name));
        }
        if (frame.channels.empty())
            throw std::runtime_error("has no channel that diptych knows; --list-channels shows them");
        return frame;
    });
}

}  // namespace diptych
