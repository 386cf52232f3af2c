// SPDX-License-Identifier: MIT
// Keys of kept results: an interrupted experiment resumes by them.
#pragma once

#include "compare/files/checkpoint_folder.h"
#include "shared/frame/frame.h"

#include <nlohmann/json.hpp>

#include <exception>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace diptych::experiment {

// FNV-1a, 64 bits (Fowler, Noll and Vo 1991), as 16 hexadecimal digits. Frames: over all channels.
std::string fingerprint(std::string_view bytes);
std::string fingerprint(std::span<const Frame* const> frames);

// Inputs of all results: this program, the scene, the Settings, the device. `truth`: fingerprint of the
// reference, which identifies the visible contents; the file's size and time detect other changes.
nlohmann::ordered_json keyOf(const std::string& scene, const std::string& truth, const Settings& settings,
                             const ReportDevice& device);

// read(JSON) of a kept result, an optional; empty if there is none. A damaged one, for which `read` throws,
// is measured again.
template <class Read>
auto findCheckpoint(const CheckpointFolder& checkpoints, const std::string& name, Read&& read)
    -> decltype(read(nlohmann::ordered_json())) {
    const nlohmann::ordered_json json = checkpoints.find(name);
    if (json.is_null()) return {};
    try {
        return read(json);
    } catch (const std::exception&) {
        return {};
    }
}

}  // namespace diptych::experiment
