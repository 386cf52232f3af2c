// SPDX-License-Identifier: MIT
#include "compare/experiment/kept.h"

#include "compare/files/our_files.h"
#include "compare/reference/key.h"
#include "compare/run/version.h"
#include "shared/text/json.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace diptych::experiment {
namespace {

using Json = nlohmann::ordered_json;

std::string digitsOf(const reference::Key& key) {
    return fmt::format("{:016x}", key.value());
}

// Size and modification time; null for a built-in scene.
Json fileFacts(const std::string& scene) {
    std::error_code error;
    const auto size = std::filesystem::file_size(scene, error);
    if (error) return nullptr;
    return {size, std::filesystem::last_write_time(scene, error).time_since_epoch().count()};
}

}  // namespace

std::string fingerprint(std::string_view bytes) {
    reference::Key key;
    key.add(std::as_bytes(std::span(bytes)));
    return digitsOf(key);
}

std::string fingerprint(std::span<const Frame* const> frames) {
    reference::Key key;
    for (const Frame* frame : frames)
        for (const auto& [mode, image] : frame->channels) key.addAll(image.data);
    return digitsOf(key);
}

Json keyOf(const std::string& scene, const std::string& truth, const Settings& settings,
           const ReportDevice& device) {
    return {{"schema", 1},
            {"software", softwareName},
            {"commit", commitName()},
            {"scene", scene},
            {"file", fileFacts(scene)},
            {"truth", truth},
            {"settings", parseOrderedJson(toJson(settings))},
            {"device", device.name},
            {"driver", device.driver}};
}

}  // namespace diptych::experiment
