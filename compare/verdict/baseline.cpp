// SPDX-License-Identifier: MIT
#include "compare/verdict/baseline.h"

#include "compare/files/frame_exr.h"
#include "compare/files/output_folder.h"

#include "compare/reference/reference.h"
#include "compare/run/version.h"
#include "compare/verdict/comparison.h"
#include "shared/image/atomic_file.h"
#include "shared/text/counted.h"
#include "shared/text/json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <stdexcept>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;

std::string differing(const Settings& a, const Settings& b) {
    const auto left = parseOrderedJson(toJson(a)), right = parseOrderedJson(toJson(b));
    std::vector<std::string> items;
    for (const auto& [key, value] : left.items())
        if (key != "path" && value != right.at(key))
            items.push_back(fmt::format("{} {} (now {})", key, value.dump(), right.at(key).dump()));
    return fmt::format("{}", fmt::join(items, ", "));
}

std::string textOf(const double (&place)[3]) {
    return fmt::format("({}, {}, {})", place[0], place[1], place[2]);
}

// Members of the camera with their names for the user.
std::vector<std::pair<const char*, std::string>> namedMembers(const FrameCamera& camera) {
    return {{"camera", camera.name.empty() ? "unnamed" : camera.name},
            {"camera eye", textOf(camera.eye)},
            {"camera target", textOf(camera.target)},
            {"camera up", textOf(camera.up)},
            {"camera fov, degrees", fmt::format("{}", camera.fov_degrees)},
            {"camera ymag, m", fmt::format("{}", camera.ymag)},
            {"camera near, m", fmt::format("{}", camera.near)},
            {"camera far, m", fmt::format("{}", camera.far)}};
}

// Old files have no camera; a valid one has one of the two.
bool isKnown(const FrameCamera& camera) {
    return camera.fov_degrees != 0 || camera.ymag != 0;
}

}  // namespace

std::vector<std::string> baselineMismatches(const Frame& baseline, const Frame& frame,
                                            const ReportDevice& device) {
    std::vector<std::string> lines;
    const FrameOrigin& origin = baseline.origin;
    const auto say = [&](const char* what, const std::string& then, const std::string& now) {
        if (then != now)
            lines.push_back(
                fmt::format("baseline: {} {} (now {})", what, then.empty() ? "unknown" : then, now));
    };
    if (isReference(baseline.settings.path) && !isReferenceFrame(baseline)) {
        lines.push_back("baseline: not written by diptych: scene, camera and Settings are unknown");
        return lines;
    }
    say("commit", origin.commit, commitName());
    say("device", origin.device, device.name);
    say("driver", origin.driver, device.driver);
    say("scene", baseline.scene, frame.scene);
    if (isKnown(baseline.camera)) {
        const auto then = namedMembers(baseline.camera), now = namedMembers(frame.camera);
        for (std::size_t i = 0; i < then.size(); ++i) say(then[i].first, then[i].second, now[i].second);
    } else {
        say("camera", "", "known");
    }
    Settings now = frame.settings;
    // The reference only depends on these of a path's Settings.
    if (isReferenceFrame(baseline)) now = withReferenceOf(referenceSettings(now), baseline.settings);
    if (const std::string settings = differing(baseline.settings, now); !settings.empty())
        lines.push_back(fmt::format("baseline: different Settings: {}", settings));
    return lines;
}

std::string samplesProblem(const Settings& reference, const Settings& path) {
    if (path.msaa == 1) return {};
    if (reference.reference_mode == ReferenceMode::surface)
        return fmt::format(
            "--msaa {}: --reference-mode surface shades one surface per pixel; use --reference-mode scene "
            "--spp 64",
            path.msaa);
    if (reference.spp < path.msaa)
        return fmt::format("--msaa {}: the reference takes only {} per pixel; use --spp 64", path.msaa,
                           counted(static_cast<std::uint64_t>(reference.spp), "sample"));
    return {};
}

std::string updateBaseline(const fs::path& file, const Frame& frame, const ReportDevice& device) {
    const fs::path old = file.string() + ".old";
    const bool fresh = !fs::exists(file);
    const auto failed = [](const fs::path& path, int error) {
        throw std::runtime_error(writingFailed(path, error));
    };
    // The new file is complete before any name changes. The old file then has both names until the new one
    // takes the first, so one always exists.
    Temporary aside(file.parent_path(), file);
    if (!aside.createFolder()) failed(file, errno);
    const fs::path name = file.filename(), kept = old.filename();
    writeFrameExr(aside.path() / name, frame, device);
    const auto held = lockTemporaries();
    if (!fresh) {
        if (aside.folder().link(name, aside.contents(), kept) != 0)
            copyBelow(file.parent_path(), name, aside.path() / kept);
        if (const int error = aside.contents().move(kept, aside.folder(), kept); error != 0)
            failed(old, error);
    }
    if (const int error = aside.contents().move(name, aside.folder(), name); error != 0) failed(file, error);
    return fresh ? fmt::format("baseline {} written from {}", file.string(), frame.name)
                 : fmt::format("baseline {} replaced from {}; the old one is now {}", file.string(),
                               frame.name, old.string());
}

}  // namespace diptych
