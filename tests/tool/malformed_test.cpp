// SPDX-License-Identifier: MIT
// Broken and hostile files through the whole program: an image, or one line and exit code 2; never a
// crash. Unit tests read every file; here is one in three.
#include "tests/support/campaign.h"
#include "tests/tool/run.h"

#include <sys/resource.h>

#include <sstream>
#include <vector>

namespace diptych {
namespace {

const fs::path malformed = fs::path(DIPTYCH_SOURCE_DIR) / "../shared/assets/malformed";

// The files of one class in MANIFEST.tsv (columns: file, fault, class, ...).
std::vector<std::string> filesOf(const std::string& wanted) {
    std::vector<std::string> files;
    std::istringstream manifest(contentsOf(malformed / "MANIFEST.tsv"));
    for (std::string line; std::getline(manifest, line);) {
        std::istringstream fields(line);
        std::string file, fault, kind;
        std::getline(fields, file, '\t');
        std::getline(fields, fault, '\t');
        std::getline(fields, kind, '\t');
        if (kind == wanted) files.push_back(file);
    }
    return files;
}

class Malformed : public testing::TestWithParam<const char*> {};

TEST_P(Malformed, FilesEndInAnImageOrOneLine) {
    if (!fs::exists(malformed))
        GTEST_SKIP() << "NO ASSETS at " << malformed << ": malformed files are not drawn";
    const Folder folder;
    const std::vector<std::string> files = filesOf(GetParam());
    EXPECT_GT(files.size(), 5u);
    const Rows rows(3);
    for (int row = 0; row < static_cast<int>(files.size()); row = rows.after(row)) {
        const std::string& file = files[static_cast<std::size_t>(row)];
        const fs::path scene = malformed / file, image = folder / "picture.png";
        fs::remove(image);
        // Ten seconds of processor time, independent of the machine's load; and a limit against hanging.
        const Ran ran = runShell(folder,
                                 "ulimit -t 10; timeout 120 '" DIPTYCH_PROGRAM "' render '" + scene.string() +
                                     "' --size 64x36 --runs 0 -q -o picture.png",
                                 folder.path());
        if (ran.code == 0)
            EXPECT_TRUE(fs::exists(image) && ran.err.empty()) << file << ": " << ran.err;
        else
            EXPECT_TRUE(ran.failedOver(scene.string() + ": ")) << file;
    }
    // The largest memory of all processes so far, including the sanitizers' own.
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    EXPECT_LT(usage.ru_maxrss, 1024 * 1024) << "KiB";
}

INSTANTIATE_TEST_SUITE_P(Classes, Malformed,
                         testing::Values("memory", "semantic", "container", "numeric", "graph"),
                         [](const auto& class_) { return std::string(class_.param); });

}  // namespace
}  // namespace diptych
