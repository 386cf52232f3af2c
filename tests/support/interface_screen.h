// SPDX-License-Identifier: MIT
// The viewer's interface without a window: what Dear ImGui draws is read as text, and clicked.
#pragma once

#include "compare/viewer/interface/fonts.h"
#include "compare/viewer/interface/interface.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace diptych::viewer {

// A run of characters on one line, with spaces as wide as they are drawn. Pixels; `y`: the line's top.
struct DrawnText {
    std::string text;
    float x = 0, y = 0, right = 0, height = 0;
};

// The texts that a frame draws, each where it is visible, in order of drawing. Only ASCII.
inline std::vector<DrawnText> textsOf(const ImDrawData& data) {
    struct Known {
        char character;
        const ImFontGlyph* glyph;
        const ImFont* font;
    };
    std::map<std::pair<float, float>, Known> glyphs;
    for (const ImFont* font : ImGui::GetIO().Fonts->Fonts)
        for (const ImFontGlyph& glyph : font->Glyphs)
            if (glyph.Visible && glyph.Codepoint < 128)
                glyphs[{glyph.U0, glyph.V0}] = {static_cast<char>(glyph.Codepoint), &glyph, font};
    std::vector<DrawnText> texts;
    const ImFont* font = nullptr;  // of the last text
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        for (const ImDrawCmd& command : list.CmdBuffer)
            for (unsigned i = 0; i + 6 <= command.ElemCount; i += 3) {
                const ImDrawIdx* const at = &list.IdxBuffer[static_cast<int>(command.IdxOffset + i)];
                const ImDrawVert& first = list.VtxBuffer[static_cast<int>(command.VtxOffset + at[0])];
                const ImDrawVert& third = list.VtxBuffer[static_cast<int>(command.VtxOffset + at[2])];
                const auto found = glyphs.find({first.uv.x, first.uv.y});
                if (found == glyphs.end() || third.uv.x != found->second.glyph->U1) continue;
                const Known& known = found->second;
                i += 3;  // a glyph is two triangles
                const float x = first.pos.x - known.glyph->X0, y = first.pos.y - known.glyph->Y0,
                            middle = 0.5f * (first.pos.x + third.pos.x),
                            height = 0.5f * (first.pos.y + third.pos.y);
                const ImVec4& clip = command.ClipRect;
                if (middle < clip.x || middle > clip.z || height < clip.y || height > clip.w) continue;
                const float space = known.font->FindGlyph(' ')->AdvanceX;
                const float gap = texts.empty() ? 0 : x - texts.back().right;
                if (texts.empty() || font != known.font || std::abs(texts.back().y - y) > 0.5f || gap < -1 ||
                    gap > 2.5f * space)
                    texts.push_back({"", x, y, x, known.font->FontSize});
                else
                    texts.back().text.append(static_cast<std::size_t>(std::lround(gap / space)), ' ');
                font = known.font;
                texts.back().text += known.character;
                texts.back().right = x + known.glyph->AdvanceX;
            }
    }
    return texts;
}

// An interface of some size at scale 1, its state and contents.
class InterfaceScreen {
public:
    InterfaceScreen() {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1280, 900};
        io.DeltaTime = 0.1f;
        loadFonts(1);
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        for (int i = 0; i < ImGuiKey_COUNT; ++i) setKey(i);
    }
    ~InterfaceScreen() { ImGui::DestroyContext(); }
    InterfaceScreen(const InterfaceScreen&) = delete;

    InterfaceState state;
    Contents contents;

    // Draws a frame, and more if it has just opened a tab: texts are those of the last one.
    void draw(int frames = 3) {
        for (int i = 0; i < frames; ++i) {
            ImGui::NewFrame();
            const auto [width, height] = ImGui::GetIO().DisplaySize;
            const CanvasRect canvas = canvasOf(state, static_cast<int>(width), static_cast<int>(height), 1);
            drawInterface(state, contents, canvas, panelRectsOf(canvas, state), 1);
            ImGui::Render();
        }
        texts = textsOf(*ImGui::GetDrawData());
    }
    void open(Tab tab) {
        state.open = tab;
        draw();
    }

    std::vector<DrawnText> texts;
    // All texts, a line each.
    std::string all() const {
        std::string lines;
        for (const DrawnText& text : texts) lines += text.text + "\n";
        return lines;
    }
    bool shows(const std::string& text) const { return all().find(text) != std::string::npos; }

    // The text that is or begins with `text`; it must be on the screen.
    DrawnText at(const std::string& text) const {
        for (const bool whole : {true, false})
            for (const DrawnText& each : texts)
                if (whole ? each.text == text : each.text.starts_with(text)) return each;
        ADD_FAILURE() << "not on the screen: " << text << "\n" << all();
        return {};
    }
    void point(float x, float y) {
        ImGui::GetIO().MousePos = {x, y};
        draw();
    }
    void pointAt(const std::string& text) {
        const DrawnText there = at(text);
        point(0.5f * (there.x + there.right), there.y + 0.5f * there.height);
    }
    // A click at `right` of the text, by `beside` pixels; otherwise on it.
    void click(const std::string& text, float beside = 0) {
        const DrawnText there = at(text);
        point(beside > 0 ? there.right + beside : 0.5f * (there.x + there.right),
              there.y + 0.5f * there.height);
        press(true);
        press(false);
    }
    // Clicks a text of an open list. The list covers what is below, so the text that was drawn last counts.
    void choose(const std::string& text) {
        const auto found =
            std::find_if(texts.rbegin(), texts.rend(), [&](const DrawnText& t) { return t.text == text; });
        ASSERT_NE(found, texts.rend()) << "not in the list: " << text << "\n" << all();
        point(found->x + 2, found->y + 0.5f * found->height);
        press(true);
        press(false);
    }
    void drag(float dx) {
        const ImVec2 from = ImGui::GetIO().MousePos;
        press(true);
        point(from.x + dx, from.y);
        press(false);
    }
    void type(const std::string& text) {
        for (const char c : text) ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
        draw();
    }
    void key(ImGuiKey key) {
        keyIs(key, true);
        draw(1);
        keyIs(key, false);
        draw();
    }

private:
    void press(bool down) {
        ImGui::GetIO().MouseDown[0] = down;
        draw();
    }
#if IMGUI_VERSION_NUM >= 18700
    static void setKey(int) {}
    static void keyIs(ImGuiKey key, bool down) {
        ImGui::GetIO().AddKeyEvent(key, down);
    }
#else
    static void setKey(int key) {
        ImGui::GetIO().KeyMap[key] = key;
    }
    static void keyIs(ImGuiKey key, bool down) {
        ImGui::GetIO().KeysDown[key] = down;
    }
#endif
};

}  // namespace diptych::viewer
