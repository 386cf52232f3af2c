// SPDX-License-Identifier: MIT
#include "compare/viewer/interface/fonts.h"

#include <imgui.h>
#include <unistd.h>

#include <cmath>

namespace diptych::viewer {
namespace {

constexpr double textHeight = 16, evenHeight = 15, builtinHeight = 13;  // pixels, at scale 1

// Latin, Greek and Cyrillic, for names of lights and cameras.
constexpr ImWchar glyphs[] = {0x20, 0x24f, 0x370, 0x52f, 0x2010, 0x2044, 0};

void add(const char* file, double height, double scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const auto pixels = [&](double of) { return static_cast<float>(std::round(of * scale)); };
    if (::access(file, R_OK) == 0 && atlas.AddFontFromFileTTF(file, pixels(height), nullptr, glyphs)) return;
    ImFontConfig config;
    config.SizePixels = pixels(builtinHeight);
    atlas.AddFontDefault(&config);
}

}  // namespace

void loadFonts(double scale) {
    ImGui::GetIO().Fonts->Clear();
    add("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", textHeight, scale);
    add("/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", evenHeight, scale);
}

ImFont* evenFont() {
    return ImGui::GetIO().Fonts->Fonts.back();
}

}  // namespace diptych::viewer
