// SPDX-License-Identifier: MIT
// Size of a report on disk.
#include "tests/tool/run.h"

#include <map>
#include <set>

namespace diptych {
namespace {

// Megabytes at the default size, without the EXRs; and the files left by --keep and --single-file.
TEST(ReportFiles, AReportOfWhatPassesIsSmall) {
    const Folder folder;
    const auto sizes = [&](const fs::path& report) {
        std::map<std::string, std::uintmax_t> bytes;
        for (const auto& entry : fs::recursive_directory_iterator(report))
            if (entry.is_regular_file()) bytes[entry.path().extension()] += entry.file_size();
        return bytes;
    };
    ASSERT_EQ(runTool(folder, "compare --runs 0 -q --shadows off -o all").code, 0);
    std::uintmax_t all = 0;
    for (const auto& [ending, bytes] : sizes(folder / "all"))
        if (ending != ".exr") all += bytes;
    // Geometric normals are 0.9 MB of that; they differ by their encoding.
    EXPECT_LT(all, 13'100'000u);
    EXPECT_GT(sizes(folder / "all")[".png"], 1'000'000u) << "the pictures are there";
    ASSERT_EQ(
        runTool(folder, "compare --keep failing -q -o failing builtin:triangle --size 48x27 --runs 0").code,
        0);
    const auto failing = sizes(folder / "failing");
    EXPECT_FALSE(failing.contains(".png") || failing.contains(".exr") || failing.contains(".js"));
    ASSERT_EQ(
        runTool(folder, "compare --single-file -q -o single builtin:triangle --size 48x27 --runs 0").code, 0);
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder / "single")) names.insert(entry.path().filename());
    EXPECT_EQ(names, (std::set<std::string>{"index.html", "junit.xml", "report.json"}));
}

}  // namespace
}  // namespace diptych
