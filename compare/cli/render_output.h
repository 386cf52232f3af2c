// SPDX-License-Identifier: MIT
// What `render` draws and writes, of one picture or of many.
#pragma once

#include "compare/cli/commands.h"
#include "compare/files/output.h"
#include "compare/report/frame_files.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace diptych::cli {

inline constexpr const char* single_manifest = "frame.json";  // in a folder that holds one Frame
// In a folder that holds a folder for each Frame, or the numbered pictures of --frames.
inline constexpr const char* several_manifest = "frames.json";

Output outputIn(const Options& options);
// The folder of one of several Frames: "1" of the first.
std::filesystem::path numbered(const std::filesystem::path& folder, std::size_t frame);
// One Frame may replace several and the other way round. Throws, naming -o, where something cannot be
// replaced: call it before the first Frame is drawn.
void checkFolder(const Output& output, std::size_t count, bool force);
// What an earlier render left, one Frame or several.
std::vector<std::string> earlierIn(const std::filesystem::path& folder);

// Asked for by name, a channel must be there, or it throws; of "all", a path gives what it can.
void checkChannels(const Options& options);
// What pictures show: the channels asked for by name, and --debug; without either, lit.
ShownChannels shownChannels(const Options& options);
// What the files need: an EXR the channels asked for; pictures those that they show, lit for its exposure,
// and which pixels are background.
std::vector<int> channelsFor(OutputKind kind, const Options& options, std::vector<int> requested);
// Notes what was given for and the path ignores.
void noteIgnored(const Options& options);

// The JSON of a run, without Frames.
nlohmann::ordered_json resultOf(const ReportDevice& made);
// What is said to have made Frames; the reference needs no device.
ReportDevice madeBy(const std::optional<Device>& device);
// Where in the command's time drawing ends: writing takes as long as five frames drawn (lavapipe, the gallery
// at 1280x720 with all channels).
double drawnShare(const RenderOptions& render);
// "x.lit.png, x.normals.png"
std::string pictureNames(const std::vector<std::filesystem::path>& files);

// render --frames N: numbered pictures of one scene, each written as soon as it is drawn.
int runFrames(const Options& options);

}  // namespace diptych::cli
