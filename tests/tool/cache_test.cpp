// SPDX-License-Identifier: MIT
// A cache folder that other users may have filled.
#include "shared/image/exr.h"
#include "tests/tool/run.h"

#include <sys/stat.h>

namespace diptych {
namespace {

TEST(UserCacheTool, AFolderThatOthersMayWriteToIsNamedOnceAndLeftAlone) {
    const Folder folder;
    const fs::path cache = folder / "cache/diptych";
    fs::create_directories(cache);
    const Image sky(8, 4, 3);
    writeExr(folder / "sky.exr", {{{"R", "G", "B"}, &sky}});
    const std::string render =
        "XDG_CACHE_HOME='" + cache.parent_path().string() +
        "' '" DIPTYCH_PROGRAM
        "' render builtin:triangle --env sky.exr --ibl-samples 1 --size 16x9 --runs 0 -q -o r";
    for (const mode_t mode : {0777, 0755}) {
        ASSERT_EQ(::chmod(cache.c_str(), mode), 0);
        const Ran ran = runShell(folder, render, folder.path());
        EXPECT_EQ(ran.code, 0);
        EXPECT_EQ(ran.err,
                  mode == 0755
                      ? ""
                      : "diptych: note: " + cache.string() +
                            ": not used as a cache: other users may write to it; run chmod go-w on it\n");
        EXPECT_EQ(fs::is_empty(cache), mode == 0777) << "the control: the maps of its environment are kept";
    }
}

}  // namespace
}  // namespace diptych
