// SPDX-License-Identifier: MIT
// The commands of the tool. Each prints its result on stdout, returns the exit code, and throws
// std::runtime_error, one line, where it could not do what was asked.
#pragma once

#include "compare/cli/options.h"
#include "compare/render/frame_facts.h"
#include "compare/render/reference_frame.h"
#include "compare/render/renderer.h"
#include "compare/render/shown_scene.h"
#include "compare/report/trends.h"
#include "compare/run/progress.h"
#include "compare/verdict/comparison.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {
class KeptReferences;
}

namespace diptych::cli {

int runCommand(const Options& options);

int runCompare(const Options& options);
int runPixel(const Options& options);  // compare --pixel
int runRender(const Options& options);
int runDiff(const Options& options);
int runTradeoff(const Options& options);
int runMerge(const Options& options);
int runAccept(const Options& options);
int runSubmit(const Options& options);
int runBench(const Options& options);
int runExplain(const Options& options);
int runChoose(const Options& options);
int runAudit(const Options& options);
int runRelations(const Options& options, const Settings& settings);  // audit --relations, with these Settings
int runPlan(const Options& options);
int runDevices(const Options& options);
int runView(const Options& options);
int runCalibrate(const Options& options);

// What the commands share.

// One Settings per camera, time and path, the paths of one camera and time side by side. Throws the first
// problem().
std::vector<Settings> settingsOf(const Options& options, const std::vector<Path>& paths);

// Standard error; empty with --quiet.
std::optional<ProgressOutput> progressOutput(const Options& options);

// The exposure that was asked for, or that of --match-exposure's file, which is read now.
PictureChoice pictureChoice(const Options& options);

RenderOptions renderOptions(const Options& options);
DeviceOptions deviceOptions(const Options& options);
// The device of --against-device; nullptr where none is asked for.
std::unique_ptr<Device> againstDevice(const Options& options);

// Throws where -o was given to a command that writes no file.
void refuseOut(const Options& options);

// The folder named by -o, or `name` where none is given, for `what` ("benchmark"); throws where -o is no
// folder or there is something else than an earlier one, which holds `manifest` (output.h).
std::filesystem::path outputFolder(const Options& options, const char* name, const char* what,
                                   const char* manifest);

// With --validate any message of the layers is a failure: throws how many there were and the first one.
void checkValidation(const Device& device);

// The share of loading in the time until `frames` Frames of a scene are drawn, 0 to 1.
double loadingShare(const std::string& scene, const RenderOptions& render, std::size_t frames);

// Print a line on stderr: note() unless --quiet was given, say() only with --verbose.
void note(const Options& options, const std::string& line);
void say(const Options& options, const std::string& line);

// With exit code 2 although something was done: the first of what was not, in one line on stderr, also with
// --quiet.
void sayErrors(const std::vector<SceneError>& errors);
// What keeps a merge from being all of its command: the first in a line of its own, which is what stderr has
// of exit code 2; all with -v.
void sayProblems(const Options& options, const std::vector<std::string>& problems,
                 const std::filesystem::path& page);

// Prints on stdout what people read, in colour where --color or the terminal says so.
void printColored(const Options& options, const std::string& text);

// What has changed since the report of --since, read where one is given: of comparisons with these rows. And
// whether it is one at all, before anything long is done: throws std::runtime_error naming it where it is
// none.
std::shared_ptr<const Trends> sinceOf(const Options& options, const Report& report,
                                      const std::vector<IndexRow>& rows);
void checkSince(const Options& options);
std::string sinceText(const Trends* since, const Report& report);  // lines for a terminal

// note() on references that other commands with this output have left half done.
void noteLeftByOthers(const Options& options, const KeptReferences& kept);

}  // namespace diptych::cli
