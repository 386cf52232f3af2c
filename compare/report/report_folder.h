// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace diptych {

// A folder's new contents, made aside and put in place when they are whole. Without put() nothing of them
// stays. Throws std::runtime_error naming the folder.
class ReportFolder {
public:
    // A name without a file: the temporary folder stands beside it. A folder that is there keeps its place
    // (it may be a mount or somebody's working directory): the temporary stands in it.
    explicit ReportFolder(const std::filesystem::path& folder);
    ~ReportFolder();
    ReportFolder(const ReportFolder&) = delete;
    ReportFolder& operator=(const ReportFolder&) = delete;

    std::filesystem::path operator/(const std::string& file) const { return temporary_ / file; }

    // Moves `files` into place, `mark` as the last, and removes what the earlier mark, if it is ours,
    // lists beside them.
    void put(const std::vector<std::string>& files, const std::string& mark);

private:
    std::filesystem::path folder_, temporary_;
    bool fresh_;
};

}  // namespace diptych
