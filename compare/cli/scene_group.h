// SPDX-License-Identifier: MIT
// Options of every command that renders: scenes, Settings, channels and images, device.
#pragma once

#include "compare/cli/output_group.h"
#include "compare/frames/frame_properties.h"
#include "compare/image/channel_image.h"
#include "compare/render/load_scene.h"
#include "compare/render/reference_frame.h"
#include "compare/render/renderer.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/settings.h"
#include "shared/frame/sides.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device/device.h"

#include <array>

namespace diptych::cli {

struct SettingsGroup {
    Settings settings;                     // camera and time are the first of cameras and times
    SideSettings sides;                    // --deferred, --forward-plus
    std::vector<std::string> cameras{""};  // one Frame per camera, scene and path
    std::vector<double> times{0.0};        // --times: s; one Frame per time, camera, path, scene
    int frames = 1;                        // number of images; the first is at settings.time
    double fps = 30;                       // images per second
    bool camera_requested = false;         // by --camera or --settings
    bool path_requested = false;           // by --path
    bool size_requested = false, shadows_requested = false;  // also by --settings
    // Why --frames takes no more than 1; empty: it does.
    std::string frames_refused = "only render takes it";

    struct {
        std::vector<std::pair<std::string, std::string>> settings;  // in command-line order
        std::vector<std::string> cameras;
        std::string file;
        std::array<std::string, 2> sides;  // by drawn_paths: NAME=VALUE,...
        std::optional<std::string> times;
        std::optional<int> frames;
        std::optional<double> fps;
    } settings_text;  // as parsed
};

struct ImageGroup {
    Channel shown = Channel::lit;   // of the image
    bool debug_requested = false;   // by --debug
    bool heat = false;              // --heat: shows the light count, overriding --debug
    std::vector<Channel> channels;  // debug modes, ascending; empty: all supported
    ImageChoice image;
    std::filesystem::path match_exposure;  // image that sets the exposure; empty: none
    bool list_channels = false;

    struct {
        std::string debug, channels;
    } image_text;  // as parsed
};

struct DeviceGroup {
    std::string device;          // index or part of a name
    std::string against_device;  // the second device; empty: none
    bool validate = false;
};

struct SceneGroup : OutputGroup, SettingsGroup, ImageGroup, DeviceGroup {
    std::vector<std::string> scenes;
    bool scene_requested = false;  // by a scene argument
    int runs = 2;                  // timed frames
    std::optional<int> runs_requested;
};

inline constexpr const char* one_scene_help = "glTF files, or builtin:NAME (builtin:gallery)";
inline constexpr const char* many_scenes_help =
    "glTF files, builtin:NAME, folders, patterns as 'scenes/**/*.glb', lists as @scenes.txt "
    "(builtin:gallery)";

// The scenes, whose help is given, Settings but one, images, device and runs. --frames and --fps are
// hidden.
void addScene(CLI::App& app, SceneGroup& options, const char* scenes_help, const std::string& except = "");
// Its parts.
void addSettings(CLI::App& app, SettingsGroup& options, const std::string& except = "");
void addImage(CLI::App& app, ImageGroup& options);
void addDevice(CLI::App& app, DeviceGroup& options);
// --deferred and --forward-plus
void addSides(CLI::App& app, SettingsGroup& options);
// --against-device
void addAgainst(CLI::App& app, DeviceGroup& options, const char* does);
// --compile-on
void addCompileOn(CLI::App& app, std::string& device, const char* does, const char* group);

void resolveScene(SceneGroup& options);
// Throws what --against-device does not support.
[[noreturn]] void refuseAgainst(const DeviceGroup& options, const std::string& why);
// Refuses several samples per pixel for --against-device.
void checkOneSample(const DeviceGroup& options, const std::vector<Settings>& settings);
// Throws std::runtime_error with the first problem().
void checkSettings(const Settings& settings);
// Also refuses the reference, against which errors are measured.
void checkMeasured(const Settings& settings);

// One Settings per camera, time and path; the paths of one camera and time are adjacent. Throws
// std::runtime_error with the first problem().
std::vector<Settings> settingsOf(const SettingsGroup& options, const std::vector<Path>& paths);
// Animation time, s, of image `frame` of --frames, counted from 0.
inline double timeOfFrame(const SettingsGroup& options, int frame) {
    return options.settings.time + frame / options.fps;
}

// The exposure of the options. Reads the file of --match-exposure.
ImageChoice imageChoice(const ImageGroup& options);
// --list-channels. Returns the exit code.
int listChannels(bool json);

RenderOptions renderOptions(const SceneGroup& options);
DeviceOptions deviceOptions(const DeviceGroup& options);
// The device of --against-device; nullptr without the option.
std::unique_ptr<Device> againstDevice(const DeviceGroup& options);

// Calls note() for unfinished references of other commands with the same output.
void noteLeftByOthers(const OutputGroup& options, const ReferenceCheckpoints& checkpoints);

}  // namespace diptych::cli
