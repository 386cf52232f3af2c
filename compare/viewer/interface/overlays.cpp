// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/overlays.h"

#include "compare/image/heat.h"
#include "compare/viewer/drawing/images.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace diptych::viewer {
namespace {

constexpr ImU32 white = IM_COL32(255, 255, 255, 255), black = IM_COL32(0, 0, 0, 255),
                grey = IM_COL32(190, 190, 190, 255);

// Text over an image, outlined so that it is readable on any background.
void drawOutlined(float x, float y, std::uint32_t color, const std::string& text) {
    ImDrawList* const list = ImGui::GetBackgroundDrawList();
    for (const auto& [dx, dy] : {std::pair{-1.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, -1.0f}, {0.0f, 1.0f}})
        list->AddText({x + dx, y + dy}, black, text.c_str());
    list->AddText({x, y}, color, text.c_str());
}

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

}  // namespace

void drawOverlays(const InterfaceState& state, const Contents& contents, const CanvasRect& canvas,
                  const std::vector<PanelRect>& panel_rects, float scale) {
    if (state.light_debug) lights(contents, panel_rects, scale);
    chosenPixel(state, panel_rects, scale);
    wipeLine(state, canvas, panel_rects, scale);
    values(contents, panel_rects, scale);
    legends(contents, canvas, panel_rects, scale);
    titles(state, contents, panel_rects, scale);
}

}  // namespace diptych::viewer
