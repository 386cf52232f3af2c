// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/tabs.h"

#include "compare/viewer/interface/widgets.h"
#include "shared/scene/lights/lights_json.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace diptych::viewer {
namespace {

void animationRows(InterfaceState& state, const SceneProperties& properties) {
    if (properties.animations.empty()) return;
    ImGui::Separator();
    auto time = static_cast<float>(state.subject.settings.time);
    ImGui::SetNextItemWidth(17 * ImGui::GetFontSize());
    if (ImGui::SliderFloat("time, s", &time, 0, static_cast<float>(std::max(properties.duration, 1e-3)),
                           "%.3f"))
        setOption(state, "time", fmt::format("{}", time));
    ImGui::SameLine();
    if (ImGui::SmallButton(state.playing ? "stop (K)" : "play (K)")) state.playing = !state.playing;
}

const char* unitOf(LightKind kind) {
    if (kind == LightKind::directional) return "lx";
    return kind == LightKind::point || kind == LightKind::spot ? "cd" : "W/(sr m^2)";
}

void lightRows(InterfaceState& state, const Contents& contents) {
    ImGui::Separator();
    bool own = state.subject.settings.scene_lights;
    if (ImGui::Checkbox("the scene's own lights (L)", &own))
        setOption(state, "scene-lights", own ? "on" : "off");
    bool rig = !state.subject.settings.lights.empty();
    const std::string named = rig ? state.subject.settings.lights : state.rig;
    if (!named.empty() && ImGui::Checkbox(fmt::format("lights {} (J)", named).c_str(), &rig)) {
        if (!rig) state.rig = named;
        setOption(state, "lights", rig ? named : "none");
    }
    ImGui::Checkbox("show positions and ranges (Q)", &state.light_debug);
    if (!contents.shown) return;
    if (!beginTable("lights", {"light", "type", "intensity", "range, m"}, 0, ImGuiTableFlags_ScrollY,
                    {0, ImGui::GetFontSize() *
                            std::min(14.0f, 2 * static_cast<float>(contents.shown->lights.size() + 1))}))
        return;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(contents.shown->lights.size()));
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Light& light = contents.shown->lights[static_cast<std::size_t>(i)];
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::Text("%d %s", i, light.name.c_str());  // one line: a clipper needs rows of equal height
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", light.name.c_str());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(std::string(nameOf(light.kind)).c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.4g %s", double{light.intensity}, unitOf(light.kind));
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(std::isfinite(light.range) ? fmt::format("{:.4g}", light.range).c_str()
                                                              : "none");
        }
    ImGui::EndTable();
}

void planRows(const Contents& contents) {
    if (!contents.shown || contents.shown->plan.empty()) return;
    for (const bool modelled : {true, false}) {
        if (!ImGui::CollapsingHeader(modelled ? "Modelled for this scene" : "Left out, and why",
                                     modelled ? 0 : ImGuiTreeNodeFlags_DefaultOpen))
            continue;
        for (const Requirements::Line& line : contents.shown->plan)
            if (line.modelled == modelled) wrapped(fmt::format("{}: {}", line.what, line.why));
    }
}

}  // namespace

void sceneTab(InterfaceState& state, const Contents& contents) {
    wrapped(sceneOf(state));
    if (sceneOf(state) != state.subject.scene)
        wrapped(contents.status.loading ? "reading: " + state.subject.scene
                                        : "cannot read: " + state.subject.scene,
                contents.status.loading ? &faint : &bad);
    if (ImGui::SmallButton("read again (R)")) state.requests.reload = true;
    ImGui::SameLine();
    if (ImGui::SmallButton("copy as diptych render (Y)")) state.requests.copy = renderCommand(state);
    if (!contents.properties) return;
    const SceneProperties& properties = *contents.properties;
    ImGui::Separator();
    const std::string& camera = state.subject.settings.camera;
    ImGui::SetNextItemWidth(20 * ImGui::GetFontSize());
    if (ImGui::BeginCombo("camera (N)", camera.empty() ? "the scene's first, or the default view"
                                        : camera.find('=') != camera.npos ? "free"
                                                                          : camera.c_str())) {
        if (ImGui::Selectable("the scene's first, or the default view", camera.empty()))
            state.requests.camera = "";
        for (std::size_t i = 0; i < properties.cameras.size(); ++i)
            if (ImGui::Selectable(fmt::format("{} {}", i, properties.cameras[i]).c_str(),
                                  camera == std::to_string(i)))
                state.requests.camera = std::to_string(i);
        ImGui::EndCombo();
    }
    animationRows(state, properties);
    lightRows(state, contents);
    ImGui::Separator();
    wrapped("environment: " + state.subject.settings.env);
    if (ImGui::CollapsingHeader("Notes", ImGuiTreeNodeFlags_DefaultOpen)) {
        std::vector<std::string> notes = properties.notes;
        if (contents.shown)
            for (const PathProperties& path : contents.shown->paths)
                for (const std::string& note : path.notes)
                    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
        for (const std::string& note : notes) wrapped(note);
        if (notes.empty()) wrapped("none", &faint);
    }
    planRows(contents);
}

}  // namespace diptych::viewer
