// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/interface.h"

#include "compare/image/heat.h"
#include "compare/viewer/drawing/images.h"
#include "compare/viewer/interface/keys.h"
#include "compare/viewer/interface/panels.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace diptych::viewer {
namespace {

constexpr ImU32 white = IM_COL32(255, 255, 255, 255), black = IM_COL32(0, 0, 0, 255),
                grey = IM_COL32(190, 190, 190, 255);

// ---- the bar ------------------------------------------------------------------------------------------

template <class Value, class Name>
void combo(const char* label, float width, Value& value, std::initializer_list<Value> values,
           const Name& name) {
    ImGui::SetNextItemWidth(width);
    if (!ImGui::BeginCombo(label, std::string(name(value)).c_str())) return;
    for (const Value each : values)
        if (ImGui::Selectable(std::string(name(each)).c_str(), each == value)) value = each;
    ImGui::EndCombo();
}

std::string_view nameOf(Layout layout) {
    switch (layout) {
        case Layout::wipe:
            return "wipe";
        case Layout::side_by_side:
            return "side by side";
        case Layout::single:
            return "one panel";
    }
    return {};
}

void channelCombo(InterfaceState& state, float width) {
    const DebugMode& now = debugMode(state.view_options.mode);
    ImGui::SetNextItemWidth(width);
    if (!ImGui::BeginCombo("##channel", fmt::format("{} {}", channelIndex(now.channel), now.name).c_str(),
                           ImGuiComboFlags_HeightLarge))
        return;
    for (const DebugMode& mode : debugModes()) {
        if (ImGui::Selectable(fmt::format("{} {}", channelIndex(mode.channel), mode.name).c_str(),
                              mode.channel == state.view_options.mode))
            state.view_options.mode = mode.channel;
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(mode.shows).c_str());
    }
    ImGui::EndCombo();
}

void exposureInput(InterfaceState& state, const Contents& contents, float width) {
    bool automatic = !state.view_options.exposure && !state.view_options.ev100;
    if (ImGui::Checkbox("auto", &automatic)) {
        state.view_options.exposure.reset();
        state.view_options.ev100.reset();
        if (!automatic) state.view_options.exposure = 1;
    }
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("exposure: %s", contents.shown ? contents.shown->scale.c_str() : "automatic");
    if (!state.view_options.exposure) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(width);
    auto factor = static_cast<float>(*state.view_options.exposure);
    if (ImGui::DragFloat("##exposure", &factor, 0.01f * factor, 1e-12f, 1e12f, "x %.4g",
                         ImGuiSliderFlags_Logarithmic) &&
        factor > 0)
        state.view_options.exposure = double{factor};
}

void bar(InterfaceState& state, const Contents& contents, int width, float scale) {
    ImGui::SetNextWindowPos({0, 0});
    const auto rows = barRows(width, double{scale});
    ImGui::SetNextWindowSize(
        {static_cast<float>(width), static_cast<float>(barHeight + barRow * rows.back()) * scale});
    ImGui::Begin("bar", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    auto next = [&, at = std::size_t{0}]() mutable {
        ++at;
        if (rows.at(at) == rows.at(at - 1)) ImGui::SameLine(0, static_cast<float>(barGap) * scale);
        ImGui::AlignTextToFramePadding();
    };
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("channel");
    ImGui::SameLine();
    channelCombo(state, 180 * scale);
    next();
    ImGui::Checkbox("heat map", &state.view_options.heat);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("how many lights each pixel evaluates (E)");
    next();
    ImGui::TextUnformatted("panels");
    ImGui::SameLine();
    combo("##layout", 115 * scale, state.canvas.layout, {Layout::wipe, Layout::side_by_side, Layout::single},
          [](Layout l) { return nameOf(l); });
    next();
    ImGui::TextUnformatted("against");
    ImGui::SameLine();
    Against against = state.view_options.against;
    combo("##against", 134 * scale, against,
          state.stored.empty()
              ? std::initializer_list<Against>{Against::paths, Against::reference}
              : std::initializer_list<Against>{Against::paths, Against::reference, Against::file},
          [](Against a) { return viewer::nameOf(a); });
    if (against != state.view_options.against) {
        state.view_options.against = against;
        state.view_options.file = against == Against::file ? state.stored : std::filesystem::path();
    }
    next();
    ImGui::TextUnformatted("difference");
    ImGui::SameLine();
    combo("##difference", 92 * scale, state.view_options.difference,
          {Difference::none, Difference::signed_difference, Difference::absolute, Difference::relative,
           Difference::flip},
          [](Difference d) { return viewer::nameOf(d); });
    next();
    exposureInput(state, contents, 90 * scale);
    next();
    if (ImGui::SmallButton("keys: H")) state.help = !state.help;
    ImGui::End();
}

// ---- the footer ---------------------------------------------------------------------------------------

void foot(InterfaceState& state, const Contents& contents, const std::vector<PanelRect>& panel_rects,
          int width, int height, float scale) {
    const float tall = static_cast<float>(footHeight) * scale;
    ImGui::SetNextWindowPos({0, static_cast<float>(height) - tall});
    ImGui::SetNextWindowSize({static_cast<float>(width), tall});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8 * scale, 4 * scale});
    ImGui::Begin("foot", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    std::string doing = contents.status.doing.empty() ? (contents.idle ? "done" : "drawing")
                                                      : fmt::format("{} {:.0f} %", contents.status.doing,
                                                                    100 * contents.status.fraction);
    if (!panel_rects.empty())
        doing = fmt::format("{}{:.3g} %   {}", state.canvas.zoom > 0 ? "zoom " : "fit, ",
                            100 * panel_rects.front().placement.scale, doing);
    const float room = ImGui::CalcTextSize(doing.c_str()).x + 24 * scale;
    const bool is_error = !contents.status.error.empty(), is_message = ImGui::GetTime() < state.message_until;
    const std::string sentence = is_error     ? contents.status.error
                                 : is_message ? state.message
                                              : belowText(contents);
    const ImVec4 color = is_error     ? ImVec4{1, 0.45f, 0.4f, 1}
                         : is_message ? ImVec4{0.6f, 0.9f, 0.6f, 1}
                                      : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    // A long line is clipped before the status; the tooltip shows all of it.
    ImGui::BeginChild("words", {std::max(1.0f, static_cast<float>(width) - room), ImGui::GetTextLineHeight()},
                      false, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(sentence.c_str());
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", sentence.c_str());
    ImGui::EndChild();
    ImGui::SameLine(std::max(0.0f, static_cast<float>(width) - room + 12 * scale));
    ImGui::TextUnformatted(doing.c_str());
    ImGui::End();
    ImGui::PopStyleVar();
}

// ---- over the images ----------------------------------------------------------------------------------

void titles(const InterfaceState& state, const Contents& contents, const std::vector<PanelRect>& panel_rects,
            float scale) {
    const DrawnView& shown = *contents.shown;
    for (const PanelRect& panel_rect : panel_rects) {
        const float x = static_cast<float>(panel_rect.rect.x) + 8 * scale,
                    y = static_cast<float>(panel_rect.rect.y) + 6 * scale;
        const bool narrow = static_cast<float>(panel_rect.rect.width) < 40 * scale;
        if (narrow) continue;
        ImGui::GetBackgroundDrawList()->PushClipRect(
            {static_cast<float>(panel_rect.rect.x), static_cast<float>(panel_rect.rect.y)},
            {static_cast<float>(panel_rect.rect.x + panel_rect.rect.width),
             static_cast<float>(panel_rect.rect.y + panel_rect.rect.height)});
        if (panel_rect.panel == 2) {
            const std::string kind = fmt::format("{} difference of {}: {} (right) and {} (left)",
                                                 viewer::nameOf(state.view_options.difference),
                                                 debugMode(shown.request.view_options.channel()).name,
                                                 shown.panels[1].name, shown.panels[0].name);
            drawOutlined(x, y, white, kind);
            if (shown.difference && !shown.difference->missing.empty())
                drawOutlined(x, y + ImGui::GetTextLineHeightWithSpacing(), grey, shown.difference->missing);
        } else {
            const Panel& panel = shown.panels.at(panel_rect.panel);
            drawOutlined(
                x, y, white,
                fmt::format("{}: {}", panel.name, debugMode(shown.request.view_options.channel()).name));
            if (!panel.missing.empty())
                drawOutlined(x, y + ImGui::GetTextLineHeightWithSpacing(), grey, panel.missing);
        }
        ImGui::GetBackgroundDrawList()->PopClipRect();
    }
}

void wipeLine(const InterfaceState& state, const CanvasRect& canvas,
              const std::vector<PanelRect>& panel_rects, float scale) {
    if (state.canvas.layout != Layout::wipe || panel_rects.empty() ||
        state.view_options.difference != Difference::none)
        return;
    const auto x =
        static_cast<float>(canvas.x) + static_cast<float>(std::lround(state.canvas.wipe * canvas.width));
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    const float middle = static_cast<float>(canvas.y) + 0.5f * static_cast<float>(canvas.height);
    list->AddLine({x, static_cast<float>(canvas.y)}, {x, static_cast<float>(canvas.y + canvas.height)}, white,
                  scale);
    list->AddTriangleFilled({x - 10 * scale, middle}, {x - 4 * scale, middle - 6 * scale},
                            {x - 4 * scale, middle + 6 * scale}, white);
    list->AddTriangleFilled({x + 10 * scale, middle}, {x + 4 * scale, middle + 6 * scale},
                            {x + 4 * scale, middle - 6 * scale}, white);
}

// A colour bar with values at its ends and middle, and a description.
template <class Color>
void legend(const CanvasRect& canvas, float scale, const Color& color,
            const std::array<std::string, 3>& values, const std::string& sentence) {
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    const float width = std::min(260 * scale, 0.6f * static_cast<float>(canvas.width)), tall = 12 * scale;
    const float left = static_cast<float>(canvas.x) + 12 * scale;
    const float top = static_cast<float>(canvas.y + canvas.height) - 56 * scale;
    list->AddRectFilled(
        {left - 6 * scale, top - 22 * scale},
        {left + std::max(width, ImGui::CalcTextSize(sentence.c_str()).x) + 6 * scale, top + 34 * scale},
        IM_COL32(0, 0, 0, 190));
    list->AddText({left, top - 20 * scale}, white, sentence.c_str());
    constexpr int steps = 64;
    for (int i = 0; i < steps; ++i) {
        const std::array<std::uint8_t, 3> c = color((i + 0.5) / steps);
        list->AddRectFilled({left + width * static_cast<float>(i) / steps, top},
                            {left + width * static_cast<float>(i + 1) / steps + 1, top + tall},
                            IM_COL32(c[0], c[1], c[2], 255));
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const float room = ImGui::CalcTextSize(values[i].c_str()).x;
        list->AddText({left + (width - room) * 0.5f * static_cast<float>(i), top + tall + 3 * scale}, white,
                      values[i].c_str());
    }
}

void legends(const Contents& contents, const CanvasRect& canvas, const std::vector<PanelRect>& panel_rects,
             float scale) {
    const DrawnView& shown = *contents.shown;
    const bool of_difference = !panel_rects.empty() && panel_rects.front().panel == 2;
    if (shown.difference && of_difference) {
        if (!shown.difference->missing.empty()) return;
        const double top = shown.difference->top;
        if (top == 0)
            drawOutlined(static_cast<float>(canvas.x) + 12 * scale,
                         static_cast<float>(canvas.y + canvas.height) - 24 * scale, white,
                         shown.difference->text + ": 0 everywhere");
        else if (shown.difference->is_signed)
            legend(
                canvas, scale,
                [](double t) { return signedColor(std::copysign((2 * t - 1) * (2 * t - 1), 2 * t - 1)); },
                {fmt::format("-{:.3g}", top), "0", fmt::format("{:.3g}", top)}, shown.difference->text);
        else
            legend(
                canvas, scale, [](double t) { return errorColor(t); },
                {"0", fmt::format("{:.3g}", 0.25 * top), fmt::format("{:.3g}", top)}, shown.difference->text);
    } else if (shown.heat_top > 0) {
        legend(
            canvas, scale, [](double t) { return heatColor(t); },
            {"0", fmt::format("{:g}", 0.5 * shown.heat_top), fmt::format("{:g}", shown.heat_top)},
            "lights per pixel");
    } else if (shown.request.view_options.channel() != Channel::lit) {
        drawOutlined(static_cast<float>(canvas.x) + 12 * scale,
                     static_cast<float>(canvas.y + canvas.height) - 24 * scale, white, shown.scale);
    }
}

// Writes values into large pixels.
void values(const Contents& contents, const std::vector<PanelRect>& panel_rects, float scale) {
    const DrawnView& shown = *contents.shown;
    const Size& full = shown.request.subject.settings.size;
    for (const PanelRect& panel_rect : panel_rects) {
        const auto [left, top, size] = panel_rect.placement;
        if (size < valuesFrom * double{scale} || (panel_rect.panel == 2 && !shown.difference)) continue;
        const Image& image =
            panel_rect.panel == 2 ? shown.difference->values : shown.panels.at(panel_rect.panel).values;
        if (image.empty() || image.width != full.width || image.height != full.height) continue;
        ImDrawList* const list = ImGui::GetBackgroundDrawList();
        list->PushClipRect({static_cast<float>(panel_rect.rect.x), static_cast<float>(panel_rect.rect.y)},
                           {static_cast<float>(panel_rect.rect.x + panel_rect.rect.width),
                            static_cast<float>(panel_rect.rect.y + panel_rect.rect.height)});
        const int x0 = std::max(0, static_cast<int>((panel_rect.rect.x - left) / size)),
                  x1 = std::min(full.width - 1,
                                static_cast<int>((panel_rect.rect.x + panel_rect.rect.width - left) / size));
        const int y0 = std::max(0, static_cast<int>((panel_rect.rect.y - top) / size)),
                  y1 = std::min(full.height - 1,
                                static_cast<int>((panel_rect.rect.y + panel_rect.rect.height - top) / size));
        const float line = ImGui::GetTextLineHeight();
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x)
                for (int c = 0; c < image.components; ++c)
                    drawOutlined(static_cast<float>(left + x * size) + 4,
                                 static_cast<float>(top + y * size) + 3 + static_cast<float>(c) * line, white,
                                 fmt::format("{:.4g}", image.at(x, y, c)));
        list->PopClipRect();
    }
}

// Projects a world point to a panel; empty behind the camera.
struct Projected {
    float x = 0, y = 0;
    double depth = 0;
};
std::optional<Projected> project(const View& view, const glm::dvec3& world, const Placement& placement,
                                 const Size& size) {
    const glm::dvec4 clip = view.clipFromWorld() * glm::dvec4(world - view.eye(), 1);
    if (!(clip.w > 0)) return std::nullopt;
    return Projected{
        static_cast<float>(placement.left + (clip.x / clip.w * 0.5 + 0.5) * size.width * placement.scale),
        static_cast<float>(placement.top + (clip.y / clip.w * 0.5 + 0.5) * size.height * placement.scale),
        clip.w};
}

// A circle of the light's range, and the light's position.
void lights(const Contents& contents, const std::vector<PanelRect>& panel_rects, float scale) {
    const DrawnView& shown = *contents.shown;
    const Size& full = shown.request.subject.settings.size;
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    for (const PanelRect& panel_rect : panel_rects) {
        list->PushClipRect({static_cast<float>(panel_rect.rect.x), static_cast<float>(panel_rect.rect.y)},
                           {static_cast<float>(panel_rect.rect.x + panel_rect.rect.width),
                            static_cast<float>(panel_rect.rect.y + panel_rect.rect.height)});
        int directional = 0;
        for (const Light& light : shown.lights) {
            const auto largest = double{std::max({light.color.x, light.color.y, light.color.z, 1e-6f})};
            const auto part = [&](float c) {
                return static_cast<int>(std::lround(80 + 175 * double{c} / largest));
            };
            const ImU32 color = IM_COL32(part(light.color.x), part(light.color.y), part(light.color.z), 255);
            if (light.kind == LightKind::directional) {
                drawOutlined(static_cast<float>(panel_rect.rect.x) + 12 * scale,
                             static_cast<float>(panel_rect.rect.y) +
                                 (48 + 18 * static_cast<float>(directional++)) * scale,
                             color,
                             fmt::format("directional {} towards {:.2f},{:.2f},{:.2f}", light.name,
                                         light.direction.x, light.direction.y, light.direction.z));
                continue;
            }
            const std::optional<Projected> at =
                project(shown.view, light.position, panel_rect.placement, full);
            if (!at) continue;
            list->AddCircleFilled({at->x, at->y}, 4 * scale, color);
            list->AddCircle({at->x, at->y}, 5 * scale, black);
            if (!std::isfinite(light.range)) continue;
            const std::optional<Projected> edge =
                project(shown.view, light.position + shown.view.up() * double{light.range},
                        panel_rect.placement, full);
            if (!edge) continue;
            const float radius = std::hypot(edge->x - at->x, edge->y - at->y);
            list->AddCircle({at->x, at->y}, std::min(radius, 8000.0f), color, 48, scale);
        }
        list->PopClipRect();
    }
}

void chosenPixel(const InterfaceState& state, const std::vector<PanelRect>& panel_rects, float scale) {
    if (!state.pixel) return;
    for (const PanelRect& panel_rect : panel_rects) {
        const auto [left, top, size] = panel_rect.placement;
        const auto x = static_cast<float>(left + state.pixel->x * size),
                   y = static_cast<float>(top + state.pixel->y * size);
        const auto side = static_cast<float>(size);
        if (!panel_rect.rect.contains(double{x} + 0.5 * size, double{y} + 0.5 * size)) continue;
        ImDrawList* const list = ImGui::GetBackgroundDrawList();
        const float edge = std::max(0.0f, 4 * scale - 0.5f * side);
        list->AddRect({x - edge - 1, y - edge - 1}, {x + side + edge + 1, y + side + edge + 1}, black, 0, 0,
                      3 * scale);
        list->AddRect({x - edge - 1, y - edge - 1}, {x + side + edge + 1, y + side + edge + 1},
                      IM_COL32(255, 230, 0, 255), 0, 0, scale);
    }
}

void help(InterfaceState& state, int width, int height, float scale) {
    if (!state.help) return;
    ImGui::SetNextWindowPos({0.5f * static_cast<float>(width), 0.5f * static_cast<float>(height)},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints(
        {0, 0}, {static_cast<float>(width), std::max(60.0f, static_cast<float>(height) - 80 * scale)});
    if (ImGui::Begin("Keys", &state.help,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove)) {
        if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg)) {
            for (const KeyBinding& binding : keyBindings()) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextColored({1, 0.9f, 0.4f, 1}, "%s", std::string(binding.name).c_str());
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(std::string(binding.does).c_str());
            }
            for (const auto& [name, does] :
                 {std::pair{"left drag",
                            "looks around; in zoom moves the picture; on the wipe's line moves the line"},
                  std::pair{"right click", "inspects a pixel: both surfaces, its lights, the tolerance"},
                  std::pair{"wheel", "changes the camera's speed; in zoom, the size of pixels"},
                  std::pair{
                      "drop a file",
                      "opens a scene, an environment (.hdr, .exr) or a stored image (.exr by Diptych)"}}) {
                ImGui::TableNextRow();
                ImGui::TableNextColumn();
                ImGui::TextColored({1, 0.9f, 0.4f, 1}, "%s", name);
                ImGui::TableNextColumn();
                ImGui::TextUnformatted(does);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

// Progress of reading the scene, while there is nothing to show yet.
void loading(const Contents& contents, const CanvasRect& canvas, float scale) {
    if (contents.shown && !contents.status.loading) return;
    const float width = std::min(420 * scale, 0.8f * static_cast<float>(canvas.width));
    ImGui::SetNextWindowPos({static_cast<float>(canvas.x) + 0.5f * static_cast<float>(canvas.width),
                             static_cast<float>(canvas.y) + 0.5f * static_cast<float>(canvas.height)},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({width, 0});
    if (ImGui::Begin(
            "loading", nullptr,
            ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings)) {
        ImGui::TextUnformatted(contents.status.doing.empty() ? "waiting" : contents.status.doing.c_str());
        ImGui::ProgressBar(static_cast<float>(contents.status.fraction));
    }
    ImGui::End();
}

}  // namespace

void drawOutlined(float x, float y, std::uint32_t color, const std::string& text) {
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    for (const auto& [dx, dy] : {std::pair{-1.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, -1.0f}, {0.0f, 1.0f}})
        list->AddText({x + dx, y + dy}, black, text.c_str());
    list->AddText({x, y}, color, text.c_str());
}

void drawInterface(InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                   const std::vector<PanelRect>& panel_rects, double scale) {
    const auto s = static_cast<float>(scale);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const int width = static_cast<int>(display.x), height = static_cast<int>(display.y);
    if (contents.shown) {
        if (state.light_debug) lights(contents, panel_rects, s);
        chosenPixel(state, panel_rects, s);
        wipeLine(state, canvas, panel_rects, s);
        values(contents, panel_rects, s);
        legends(contents, canvas, panel_rects, s);
        titles(state, contents, panel_rects, s);
    }
    bar(state, contents, width, s);
    foot(state, contents, panel_rects, width, height, s);
    if (state.panels || state.information)
        drawPanels(state, contents,
                   {canvas.x + canvas.width, canvas.y, width - canvas.x - canvas.width, canvas.height}, s);
    loading(contents, canvas, s);
    help(state, width, height, s);
}

}  // namespace diptych::viewer
