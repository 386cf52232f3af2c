// SPDX-License-Identifier: MIT
// The user's cache only accepts files of this user.
#include "shared/vulkan/instance/user_cache.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace diptych {
namespace {

namespace fs = std::filesystem;

fs::path cacheOf(mode_t mode) {
    fs::path cache = folder() / "diptych";
    fs::create_directory(cache);
    EXPECT_EQ(::chmod(cache.c_str(), mode), 0);
    return cache;
}

TEST(UserCache, AFolderOfThisUserAloneIsUsed) {
    for (const mode_t mode : {0700, 0755, 0500}) EXPECT_EQ(cacheFault(cacheOf(mode)), "") << mode;
    const fs::path cache = cacheOf(0755);
    EXPECT_EQ(cacheFault(cache / "not there yet"), "");
    fs::create_directory_symlink("diptych", cache.parent_path() / "link");
    EXPECT_EQ(cacheFault(cache.parent_path() / "link"), "") << "the user's own link";
    makeCacheFolder(cache / "a" / "b");
    EXPECT_EQ(fs::status(cache / "a" / "b").permissions(), fs::perms::owner_all);
}

TEST(UserCache, AFolderThatOthersMayWriteToIsNotUsed) {
    for (const mode_t mode : {0777, 0720, 0702, 01777}) {
        const fs::path cache = cacheOf(mode);
        EXPECT_EQ(
            cacheFault(cache),
            cache.string() + ": not used as a cache: other users may write to it; run chmod go-w on it");
    }
}

// Only root can change the owner of a folder.
TEST(UserCache, AFolderOfAnotherUserIsNotUsed) {
    const fs::path cache = cacheOf(0755), link = cache.parent_path() / "link";
    fs::create_directory_symlink("diptych", link);
    if (::lchown(link.c_str(), 65534, 65534) != 0) GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: not root";
    EXPECT_NE(cacheFault(link).find("it belongs to another user"), std::string::npos) << "another's link";
    ASSERT_EQ(::chown(cache.c_str(), 65534, 65534), 0);
    EXPECT_NE(cacheFault(cache).find("it belongs to another user"), std::string::npos);
}

TEST(UserCache, AFileIsUsedWhereNobodyElseCouldWriteIt) {
    const fs::path cache = cacheOf(0755), file = cache / "file";
    const auto used = [](const fs::path& of) { return openCacheFile(of).stream != nullptr; };
    std::ofstream(file) << "kept";
    for (const mode_t mode : {0600, 0644}) {
        ASSERT_EQ(::chmod(file.c_str(), mode), 0);
        EXPECT_TRUE(used(file)) << mode;
        EXPECT_EQ(openCacheFile(file).bytes, 4u);
    }
    for (const mode_t mode : {0664, 0646, 0666}) {
        ASSERT_EQ(::chmod(file.c_str(), mode), 0);
        EXPECT_FALSE(used(file)) << mode;
    }
    ASSERT_EQ(::chmod(file.c_str(), 0600), 0);
    fs::create_symlink("file", cache / "link");
    ASSERT_EQ(::mkfifo((cache / "pipe").c_str(), 0600), 0);
    for (const char* other : {"link", "pipe", "none"}) EXPECT_FALSE(used(cache / other)) << other;
    EXPECT_FALSE(used(cache));
    if (::chown(file.c_str(), 65534, 65534) == 0) {
        EXPECT_FALSE(used(file)) << "another's";
    }
}

}  // namespace
}  // namespace diptych
