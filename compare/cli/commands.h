// SPDX-License-Identifier: MIT
// The commands of the tool. Each prints its result on stdout and returns the exit code. Errors throw
// std::runtime_error, one line.
#pragma once

#include "compare/cli/options.h"
#include "compare/frames/frame_facts.h"
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
int runRelations(const Options& options, const Settings& settings);  // audit --relations
int runPlan(const Options& options);
int runDevices(const Options& options);
int runView(const Options& options);
int runCalibrate(const Options& options);

// Shared by the commands.

// One Settings per camera, time and path; the paths of one camera and time are adjacent. Throws
// std::runtime_error with the first problem().
std::vector<Settings> settingsOf(const Options& options, const std::vector<Path>& paths);

// stderr; empty with --quiet.
std::optional<ProgressOutput> progressOutput(const Options& options);

// The exposure of the options. Reads the file of --match-exposure.
PictureChoice pictureChoice(const Options& options);

RenderOptions renderOptions(const Options& options);
DeviceOptions deviceOptions(const Options& options);
// The device of --against-device; nullptr without the option.
std::unique_ptr<Device> againstDevice(const Options& options);

// Throws if -o is given to a command that writes no file.
void refuseOut(const Options& options);

// The folder of -o, or `name` without -o. `what` ("benchmark") is for messages. Throws if -o is not a
// folder, or if its contents have no `manifest` (output.h).
std::filesystem::path outputFolder(const Options& options, const char* name, const char* what,
                                   const char* manifest);

// Print a line on stderr: note() unless --quiet is given, say() only with --verbose.
void note(const Options& options, const std::string& line);
void say(const Options& options, const std::string& line);

// Prints the first error, one line on stderr, even with --quiet. For results with exit code 2.
void sayErrors(const std::vector<SceneError>& errors);
// Prints why a merge is incomplete: the first problem on a line of its own, all of them with -v.
void sayProblems(const Options& options, const std::vector<std::string>& problems,
                 const std::filesystem::path& page);

// Prints text for people on stdout, in colour if --color or the terminal allows it.
void printColored(const Options& options, const std::string& text);

// Prints a result on stdout above the progress line; nothing with --json or --quiet. A closed stdout does not
// end a command that writes a folder.
void printLive(const Options& options, Progress& progress, const std::string& text);

// Changes since the report of --since, for comparisons with these rows; nullptr without --since.
// checkSince() throws std::runtime_error if the file is not a report. Call it before any long work.
std::shared_ptr<const Trends> sinceOf(const Options& options, const Report& report,
                                      const std::vector<IndexRow>& rows);
void checkSince(const Options& options);
std::string sinceText(const Trends* since, const Report& report);  // lines for the terminal

// Calls note() for unfinished references of other commands with the same output.
void noteLeftByOthers(const Options& options, const KeptReferences& kept);

}  // namespace diptych::cli
