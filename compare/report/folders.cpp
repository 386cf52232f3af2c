// SPDX-License-Identifier: MIT
#include "compare/report/folders.h"

#include "compare/report/titles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string_view>

namespace diptych {
namespace {

constexpr std::size_t longestFolder = 40;
constexpr std::size_t longestFile = 160;  // a file system allows 255 bytes, including suffixes
constexpr std::size_t nowhere = ~std::size_t{0};

// 32-bit FNV-1a, of which folders show 24 bits: a thousand scenes of one name collide with probability
// 1/30.
std::uint32_t shortHashOf(std::string_view text) {
    std::uint32_t hash = 2166136261u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    return hash;
}

std::string sceneFolder(const std::string& scene) {
    constexpr std::string_view builtin = "builtin:";
    if (scene.starts_with(builtin)) {
        const std::string name = scene.substr(builtin.size());
        return nameOfFolder(name, name);
    }
    const std::filesystem::path path = std::filesystem::path(scene).lexically_normal();
    return nameOfFolder(path.stem().string(), path.string());
}

// "0_5s" for 0.5 s: folder names have no dots or plus signs.
std::string timeFolder(double seconds) {
    std::string name = fmt::format("{}s", seconds);
    std::erase(name, '+');
    std::ranges::replace(name, '.', '_');
    return name;
}

// Comparisons that share a Frame have the same scene, camera and time, a view. Stores view indices per
// frame and comparison.
struct Views {
    std::vector<std::size_t> frames, comparisons;
    std::vector<const Frame*> shown;  // per view: a Frame rendered in this run
    std::vector<std::size_t> sizes;   // per view: number of its comparisons
};

Views viewsOf(const Report& report) {
    Views views{std::vector<std::size_t>(report.frames.size(), nowhere), {}, {}, {}};
    for (const Comparison& comparison : report.comparisons) {
        std::size_t& left = views.frames[comparison.baseline];
        std::size_t& right = views.frames[comparison.test];
        const std::size_t view = std::min({left, right, views.shown.size()});
        if (view == views.shown.size()) {
            views.shown.push_back(&report.test(comparison));
            views.sizes.push_back(0);
        }
        left = right = view;
        ++views.sizes[view];
        views.comparisons.push_back(view);
    }
    return views;
}

}  // namespace

std::string hashOf(std::string_view text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return fmt::format("{:016x}", hash);
}

std::string nameOfFolder(const std::string& text, const std::string& identity) {
    std::string name;
    for (const char c : text) {
        const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
        if (kept)
            name += c;
        else if (!name.empty() && name.back() != '-')
            name += '-';
    }
    name.resize(std::min(name.size(), longestFolder));
    while (name.ends_with('-')) name.pop_back();
    if (name == identity) return name;
    return fmt::format("{}{}{:06x}", name, name.empty() ? "" : "-", shortHashOf(identity) & 0xffffff);
}

std::string nameOfFile(std::string_view name) {
    std::string safe;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte < 128 && std::isalnum(byte) != 0;
        if (plain || c == '_' || c == '-' || c == '+' || (c == '.' && !safe.empty()))
            safe += c;
        else
            safe += fmt::format("~{:02x}", byte);
    }
    if (safe.size() <= longestFile) return safe;
    return fmt::format("{}~~{}", safe.substr(0, longestFile / 2), hashOf(name));
}

std::vector<std::string> sceneFolders(const std::vector<std::string>& scenes) {
    std::vector<std::string> folders;
    std::map<std::string, int> asked;
    for (const std::string& scene : scenes) {
        std::string name = sceneFolder(scene);
        const int met = ++asked[name];
        if (met > 1) name += fmt::format("-{}", met);
        folders.push_back(name + "/");
    }
    return folders;
}

ReportFolders reportFolders(const Report& report, const std::optional<std::string>& scene_folder) {
    const Views views = viewsOf(report);
    std::vector<std::string> folders(views.shown.size());
    std::map<std::string, int> asked;
    const bool several = scene_folder ? !scene_folder->empty() : folders.size() > 1;
    for (std::size_t i = 0; i < folders.size() && several; ++i) {
        const Frame& frame = *views.shown[i];
        std::string& name = folders[i] =
            scene_folder ? scene_folder->substr(0, scene_folder->size() - 1) : sceneFolder(frame.scene);
        if (!frame.settings.camera.empty())
            name += "/" + nameOfFolder(frame.settings.camera, frame.settings.camera);
        if (namesTime(report, frame)) name += "/" + timeFolder(frame.settings.time);
        if (const int again = ++asked[name]; again > 1) name += fmt::format("-{}", again);
        name += "/";
    }
    ReportFolders result;
    for (const std::size_t view : views.frames)
        result.frames.push_back(view == nowhere ? std::string() : folders[view]);
    for (std::size_t i = 0; i < report.comparisons.size(); ++i) {
        const Comparison& comparison = report.comparisons[i];
        std::string& name = result.comparisons.emplace_back(folders[views.comparisons[i]]);
        if (views.sizes[views.comparisons[i]] > 1)
            name +=
                fmt::format("{}-against-{}/", report.test(comparison).name, report.baseline(comparison).name);
    }
    return result;
}

}  // namespace diptych
