// SPDX-License-Identifier: MIT
#include "compare/baseline.h"

#include "compare/diff.h"
#include "compare/layers.h"
#include "compare/output.h"
#include "compare/report/files.h"
#include "compare/truth.h"
#include "compare/version.h"
#include "shared/image/atomic_file.h"
#include "shared/text/json.h"
#include "shared/text/named.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <system_error>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Attributes = std::map<std::string, std::string>;

std::string valueOr(const Attributes& attributes, const char* key, const char* fallback = "") {
    const auto found = attributes.find(key);
    return found == attributes.end() ? fallback : oneLine(found->second);
}

FrameCamera cameraOf(const std::string& text) {
    const nlohmann::json json = parseJson(text);
    FrameCamera camera;
    camera.name = json.value("name", "");
    const auto vector = [&](const char* key, double(&out)[3]) {
        const auto values = json.at(key).get<std::array<double, 3>>();
        std::copy(values.begin(), values.end(), out);
    };
    vector("eye", camera.eye);
    vector("target", camera.target);
    vector("up", camera.up);
    camera.fov_degrees = json.value("fov_degrees", 0.0);
    camera.ymag = json.value("ymag", 0.0);
    camera.near = json.value("near", 0.0);
    const auto far = json.find("far");
    camera.far =
        far != json.end() && far->is_number() ? far->get<double>() : std::numeric_limits<double>::infinity();
    return camera;
}

// What our own files say of themselves.
void readOrigin(const PictureFile& file, Frame& frame) {
    const Attributes& a = file.attributes;
    frame.scene = valueOr(a, "scene", "?");
    frame.origin.device = valueOr(a, "device");
    frame.origin.driver = valueOr(a, "driver");
    frame.origin.commit = valueOr(a, "commit");
    frame.settings = settingsFromJson(a.at("settings"));
    if (a.contains("camera")) frame.camera = cameraOf(a.at("camera"));
}

bool isOurs(const PictureFile& file) {
    return valueOr(file.attributes, "software") == softwareName && file.attributes.contains("settings");
}

std::string differing(const Settings& a, const Settings& b) {
    const auto left = nlohmann::ordered_json::parse(toJson(a)),
               right = nlohmann::ordered_json::parse(toJson(b));
    std::vector<std::string> words;
    for (const auto& [key, value] : left.items())
        if (key != "path" && value != right.at(key))
            words.push_back(fmt::format("{} {} (now {})", key, value.dump(), right.at(key).dump()));
    return fmt::format("{}", fmt::join(words, ", "));
}

bool sameView(const FrameCamera& a, const FrameCamera& b) {
    return std::equal(a.eye, a.eye + 3, b.eye) && std::equal(a.target, a.target + 3, b.target) &&
           std::equal(a.up, a.up + 3, b.up) && a.fov_degrees == b.fov_degrees && a.ymag == b.ymag;
}

}  // namespace

Frame frameFromExr(const fs::path& path) {
    PictureFile file = readPicture(path);
    return named(path.string(), [&] {
        Frame frame;
        frame.name = "baseline";
        frame.origin.file = path.string();
        if (isOurs(file))
            readOrigin(file, frame);
        else
            frame.settings.path = Path::reference;
        frame.settings.size = {file.width, file.height};
        std::vector<std::string> others;
        for (PictureChannel& channel : channelsOf(std::move(file), {})) {
            const DebugMode* mode = findDebugMode(channel.name);
            if (mode && mode->name == channel.name && mode->width == channel.image.components)
                frame.channels[mode->number] = std::move(channel.image);
            else
                others.push_back(channel.name);
        }
        if (frame.channels.empty())
            throw std::runtime_error("holds no channel that is called as one of ours");
        if (!others.empty())
            frame.notes.push_back(fmt::format("{} of the baseline: not one of our channels, left out",
                                              oneLine(fmt::format("{}", fmt::join(others, ", ")))));
        return frame;
    });
}

std::vector<std::string> baselineMismatches(const Frame& baseline, const Frame& frame,
                                            const ReportDevice& device) {
    std::vector<std::string> lines;
    const FrameOrigin& origin = baseline.origin;
    const auto say = [&](const char* what, const std::string& then, const std::string& now) {
        if (then != now)
            lines.push_back(
                fmt::format("baseline: {} {} (now {})", what, then.empty() ? "unknown" : then, now));
    };
    if (baseline.settings.path == Path::reference && !isTruth(baseline)) {
        lines.push_back("baseline: not written by diptych: scene, camera and Settings are unknown");
        return lines;
    }
    say("commit", origin.commit, commitName());
    say("device", origin.device, device.name);
    say("driver", origin.driver, device.driver);
    say("scene", baseline.scene, frame.scene);
    if (!sameView(baseline.camera, frame.camera))
        lines.push_back("baseline: seen from another place or with another lens");
    Settings now = frame.settings;
    if (isTruth(baseline)) {  // of what a path is drawn with it depends on these alone
        now = referenceSettings(now);
        now.spp = baseline.settings.spp;
        now.reference_mode = baseline.settings.reference_mode;
    }
    if (const std::string settings = differing(baseline.settings, now); !settings.empty())
        lines.push_back(fmt::format("baseline: other Settings: {}", settings));
    return lines;
}

std::string updateBaseline(const fs::path& file, const Frame& frame, const ReportDevice& device) {
    const fs::path old = file.string() + ".old";
    const bool fresh = !fs::exists(file);
    const auto failed = [](const fs::path& path, int error) {
        throw std::runtime_error(writingFailed(path, error));
    };
    // The new one is whole before any name changes. The old one then has both names until the new one takes
    // its first: at no moment is there none.
    Temporary aside(file.parent_path(), file);
    if (!aside.createFolder()) failed(file, errno);
    const fs::path made = aside.path() / file.filename(), kept = aside.path() / old.filename();
    writeFrameExr(made, frame, device);
    const auto held = holdTemporaries();
    if (!fresh) {
        std::error_code error;
        fs::create_hard_link(file, kept, error);
        if (error) fs::copy_file(file, kept, error);
        if (!error) fs::rename(kept, old, error);
        if (error) failed(old, error.value());
    }
    if (std::rename(made.c_str(), file.c_str()) != 0) failed(file, errno);
    return fresh ? fmt::format("baseline {} written from {}", file.string(), frame.name)
                 : fmt::format("baseline {} written anew from {}; the old one is {}", file.string(),
                               frame.name, old.string());
}

}  // namespace diptych
