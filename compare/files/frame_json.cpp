// SPDX-License-Identifier: MIT
#include "compare/files/frame_json.h"

#include "shared/frame/debug_modes.h"
#include "shared/text/json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace diptych {

using Json = nlohmann::ordered_json;

Json finiteOrNull(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json jsonOf(const FrameCamera& camera) {
    return {{"name", camera.name},     {"choice", camera.choice}, {"eye", camera.eye},
            {"target", camera.target}, {"up", camera.up},         {"fov_degrees", camera.fov_degrees},
            {"ymag", camera.ymag},     {"near", camera.near},     {"far", finiteOrNull(camera.far)}};
}

Json jsonOf(const FrameTime& time) {
    return {{"median", time.median}, {"min", time.min}, {"max", time.max}, {"runs", time.runs}};
}

Json jsonOf(const std::vector<PassTime>& passes) {
    return arrayOf(passes, [](const PassTime& pass) -> Json {
        return {{"name", pass.name}, {"ms", pass.ms}};
    });
}

Json jsonOf(const ReportDevice& device) {
    return {{"name", device.name}, {"driver", device.driver}, {"type", device.type}};
}

Json jsonOf(const Settings& settings) {
    return parseOrderedJson(toJson(settings));
}

FrameCamera cameraFrom(const JsonAt<nlohmann::json>& json) {
    FrameCamera camera;
    camera.name = json.textOr("name", "");
    camera.choice = json.textOr("choice", "");
    const auto vector = [&](const char* key, double(&out)[3]) {
        for (std::size_t i = 0; i < 3; ++i) out[i] = json.at(key)[i].number();
    };
    vector("eye", camera.eye);
    vector("target", camera.target);
    vector("up", camera.up);
    camera.fov_degrees = json.numberOr("fov_degrees", 0);
    camera.ymag = json.numberOr("ymag", 0);
    camera.near = json.numberOr("near", 0);
    camera.far = json.has("far") && json.at("far").json().is_number()
                     ? json.at("far").number()
                     : std::numeric_limits<double>::infinity();
    return camera;
}

namespace {

Json countersJson(const FrameCounters& counters) {
    return {{"nonfinite_pixels", counters.nonfinite_pixels},
            {"overflowed_lists", counters.overflowed_lists},
            {"lights", counters.lights},
            {"unsorted", {{"fragments", counters.unsorted.fragments}, {"pixels", counters.unsorted.pixels}}},
            {"shadow_pages",
             {{"requested", counters.shadow_pages.requested},
              {"resident", counters.shadow_pages.resident},
              {"fallback", counters.shadow_pages.fallback},
              {"drawn", counters.shadow_pages.drawn}}},
            {"unreproduced_pixels", counters.unreproduced_pixels},
            {"energy_cut", counters.energy_cut}};
}

}  // namespace

Json jsonOf(const Frame& frame) {
    // Settings of another program's file are unknown.
    const bool isUnknown =
        !frame.origin.file.empty() && frame.origin.device.empty() && !frame.origin.external;
    Json noise = Json::object();
    for (const auto& [mode, of] : frame.noise)
        noise[std::string(debugMode(mode).name)] = {{"pixels", of.pixels}, {"max", finiteOrNull(of.max)}};
    Json repaired = Json::object();
    for (const auto& [mode, pixels] : frame.repaired) {
        const auto width = static_cast<std::uint32_t>(frame.settings.size.width);
        repaired[std::string(debugMode(mode).name)] = {
            {"pixels", pixels.size()}, {"first", {pixels.front() % width, pixels.front() / width}}};
    }
    Json hidden = nullptr;
    if (frame.hidden_light)
        hidden = {{"mean", frame.hidden_light->mean},
                  {"p99", frame.hidden_light->p99},
                  {"pixels_above_a_tenth", frame.hidden_light->pixels}};
    return {{"name", frame.name},
            {"path", isUnknown || frame.origin.external ? Json(nullptr) : Json(nameOf(frame.settings.path))},
            {"scene", frame.scene},
            {"camera", jsonOf(frame.camera)},
            {"size", {frame.settings.size.width, frame.settings.size.height}},
            {"settings", isUnknown ? Json(nullptr) : jsonOf(frame.settings)},
            {"ms", jsonOf(frame.time)},
            {"host_ms", {{"record", frame.time.record}, {"object_lists", frame.time.object_lists}}},
            {"made_in_ms", frame.made_in_ms},
            {"uncertainty", frame.relative_uncertainty},
            {"hidden_light", hidden},
            {"passes", jsonOf(frame.passes)},
            {"bytes",
             {{"images", frame.bytes.images},
              {"buffers", frame.bytes.buffers},
              {"gbuffer_per_pixel", frame.bytes.gbuffer_per_pixel}}},
            {"counters", countersJson(frame.counters)},
            {"noise", noise},
            {"changed_buffers", frame.changed_buffers},
            {"repaired", repaired},
            {"origin",
             {{"file", frame.origin.file},
              {"device", frame.origin.device},
              {"driver", frame.origin.driver},
              {"commit", frame.origin.commit},
              {"external", frame.origin.external},
              {"granted", frame.origin.corrections}}},
            {"notes", frame.notes}};
}

}  // namespace diptych
