// SPDX-License-Identifier: MIT
#include "compare/report/report_folder.h"

#include "compare/output.h"

#include <fmt/format.h>

#include <unistd.h>
#include <algorithm>
#include <stdexcept>

namespace diptych {

namespace fs = std::filesystem;

namespace {

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
