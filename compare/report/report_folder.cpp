// SPDX-License-Identifier: MIT
#include "compare/report/report_folder.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>
#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace diptych {

namespace fs = std::filesystem;

namespace {

// Plain names only: an edited list must not reach outside the folder.
std::vector<std::string> listedIn(const fs::path& mark) {
    std::ifstream stream(mark);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    std::vector<std::string> names;
    if (json.is_object() && json.contains("files") && json["files"].is_array())
        for (const auto& name : json["files"])
            if (name.is_string() && fs::path(name.get<std::string>()).filename() == name.get<std::string>())
                names.push_back(name);
    return names;
}

[[noreturn]] void fail(const fs::path& folder, const std::error_code& error) {
    throw std::runtime_error(fmt::format("{}: {}", folder.string(), error.message()));
}

}  // namespace

ReportFolder::ReportFolder(const fs::path& folder)
    : folder_(fs::absolute(folder).lexically_normal()), fresh_(!fs::exists(folder)) {
    if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "out/"
    const std::string name = fmt::format(".{}.{}.tmp", folder_.filename().string(), ::getpid());
    std::error_code error;
    if (fresh_) fs::create_directories(folder_.parent_path(), error);
    if (error) fail(folder, error);
    temporary_ = (fresh_ ? folder_.parent_path() : folder_) / name;
    fs::remove_all(temporary_, error);
    if (!fs::create_directory(temporary_, error)) fail(folder, error);
}

ReportFolder::~ReportFolder() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void ReportFolder::put(const std::vector<std::string>& files, const std::string& mark) {
    std::error_code error;
    if (fresh_) {
        fs::rename(temporary_, folder_, error);
        if (error) fail(folder_, error);
        temporary_.clear();
        return;
    }
    const std::vector<std::string> earlier = listedIn(folder_ / mark);
    const auto move = [&](const std::string& file) {
        fs::rename(temporary_ / file, folder_ / file, error);
        if (error) fail(folder_ / file, error);
    };
    for (const std::string& file : files)
        if (file != mark) move(file);
    for (const std::string& file : earlier)
        if (std::ranges::count(files, file) == 0 && fs::is_regular_file(fs::symlink_status(folder_ / file))) {
            fs::remove(folder_ / file, error);
            if (error) fail(folder_ / file, error);
        }
    move(mark);
}

}  // namespace diptych
