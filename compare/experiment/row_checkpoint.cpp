// SPDX-License-Identifier: MIT
#include "compare/experiment/row_checkpoint.h"

#include "compare/files/diptych_files.h"
#include "compare/files/frame_json.h"
#include "compare/reference/key.h"
#include "compare/run/version.h"

#include <fmt/format.h>

namespace diptych::experiment {
namespace {

using Json = nlohmann::ordered_json;

std::string digitsOf(const reference::Key& key) {
    return fmt::format("{:016x}", key.value());
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
            {"file", fileStamp(scene)},
            {"truth", truth},
            {"settings", jsonOf(settings)},
            {"device", device.name},
            {"driver", device.driver}};
}

}  // namespace diptych::experiment
