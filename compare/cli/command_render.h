// SPDX-License-Identifier: MIT
// Outputs of `render`, for one image or many.
#pragma once

#include "compare/cli/scene_group.h"
#include "compare/files/output.h"
#include "compare/report/frame_files.h"

#include <nlohmann/json.hpp>

#include <cstddef>

namespace diptych::cli {

inline constexpr const char* single_manifest = "frame.json";  // in a folder of one Frame
// In a folder with one folder per Frame, or with the numbered images of --frames.
inline constexpr const char* frames_manifest = "frames.json";

struct RenderLine : SceneGroup {
    bool list_scenes = false;
};

Output outputIn(const OutputGroup& options);
// The folder of one of several Frames: "1" for the first.
std::filesystem::path numbered(const std::filesystem::path& folder, std::size_t frame);
// Throws, naming -o, if the output cannot be replaced: call before rendering. Folders of one and of
// several Frames may replace each other.
void checkFolder(const Output& output, std::size_t count, bool force);
// The same for a folder; returns the files of an earlier render, one Frame or several.
std::vector<std::string> earlierIn(const Output& output, std::size_t count, bool force);

// Throws if the path does not support a channel that was requested by name.
void checkChannels(const RenderLine& options);
// Channels shown in images: those requested by name, and --debug. Default: lit.
ChannelSelection selectedChannels(const RenderLine& options);
// Channels to render. An EXR needs the requested ones. Images need the shown ones, lit for the exposure,
// and material_id for the background.
std::vector<Channel> channelsFor(OutputKind kind, const RenderLine& options, std::vector<Channel> requested);
// Notes options that the path ignores.
void noteIgnored(const RenderLine& options);

// The JSON of a run, with an empty list of Frames.
nlohmann::ordered_json resultOf(const ReportDevice& made);
// The device named in the output; the reference needs none.
ReportDevice reportDeviceOf(const std::optional<Device>& device);
// Fraction of the command's time after which rendering ends. Writing takes as long as five rendered frames
// (lavapipe, gallery, 1280x720, all channels).
double drawnFraction(const RenderOptions& render);
// "x.lit.png, x.normals.png"
std::string imageNames(const std::vector<std::filesystem::path>& files);

// render --frames N: numbered images of one scene, each written as soon as it is rendered.
int runFrames(const RenderLine& options);

}  // namespace diptych::cli
