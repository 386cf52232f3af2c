// SPDX-License-Identifier: MIT
// The pipeline cache's file: only the same device, driver and program read it back, and only if it is
// complete.
#include "shared/vulkan/device/pipeline_cache.h"
#include "shared/vulkan/instance/user_cache.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <functional>
#include <optional>

using namespace diptych;

namespace {

namespace fs = std::filesystem;

std::vector<std::byte> someData(std::size_t count) {
    std::vector<std::byte> data;
    for (std::size_t i = 0; i < count; ++i) data.push_back(static_cast<std::byte>(i * 7));
    return data;
}

PipelineCacheKey someKey() {
    PipelineCacheKey key;
    for (std::size_t i = 0; i < key.driver.size(); ++i) key.driver[i] = static_cast<std::uint8_t>(i);
    key.program = 0x123456789abcdef0u;
    key.vendor = 0x10de;
    key.device = 0x2335;
    key.driver_version = 550;
    key.api_version = VK_API_VERSION_1_3;
    return key;
}

// Sets an environment variable and restores it on destruction.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* const old = std::getenv(name)) old_ = old;
        set(value);
    }
    ~Variable() { set(old_ ? old_->c_str() : nullptr); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    void set(const char* value) const {
        if (value)
            ::setenv(name_, value, 1);
        else
            ::unsetenv(name_);
    }
    const char* name_;
    std::optional<std::string> old_;
};

}  // namespace

TEST(PipelineCache, WhatIsKeptComesBackUnderTheSameKey) {
    const fs::path target = folder();
    const fs::path file = pipelineCacheFile(target / "made" / "for it", someKey());
    EXPECT_TRUE(readPipelineCache(file, someKey()).empty());
    for (const std::size_t count : {1000u, 10u, 0u}) {
        ASSERT_TRUE(writePipelineCache(file, someKey(), someData(count)));
        EXPECT_EQ(readPipelineCache(file, someKey()), someData(count)) << count;
    }
    EXPECT_EQ(namesIn(file.parent_path()).size(), 1u) << "a temporary file stays";
}

TEST(PipelineCache, AnotherDriverDeviceOrProgramGetsNothing) {
    const fs::path target = folder();
    const fs::path file = target / "pipelines";
    ASSERT_TRUE(writePipelineCache(file, someKey(), someData(100)));
    using Change = std::function<void(PipelineCacheKey&)>;
    const std::vector<Change> others{
        [](PipelineCacheKey& key) { key.driver.back() ^= 1; },
        [](PipelineCacheKey& key) { ++key.program; },
        [](PipelineCacheKey& key) { ++key.vendor; },
        [](PipelineCacheKey& key) { ++key.device; },
        [](PipelineCacheKey& key) { ++key.driver_version; },
        [](PipelineCacheKey& key) { ++key.api_version; },
    };
    for (std::size_t i = 0; i < others.size(); ++i) {
        PipelineCacheKey other = someKey();
        others[i](other);
        EXPECT_TRUE(readPipelineCache(file, other).empty()) << i;
        // Another program's file is overwritten, another driver's file stays.
        EXPECT_EQ(pipelineCacheFile(target, other) == pipelineCacheFile(target, someKey()), i == 1) << i;
    }
    EXPECT_FALSE(readPipelineCache(file, someKey()).empty());
}

TEST(PipelineCache, DamagedFilesAreIgnoredAndWrittenOver) {
    const fs::path target = folder();
    const fs::path file = target / "pipelines";
    ASSERT_TRUE(writePipelineCache(file, someKey(), someData(100)));
    const std::string whole = contentsOf(file);
    const auto readWith = [&](const std::string& contents) {
        std::ofstream(file, std::ios::binary) << contents;
        return readPipelineCache(file, someKey());
    };
    EXPECT_EQ(readWith(whole), someData(100));
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        EXPECT_TRUE(readWith(damaged).empty()) << "byte " << at;
        EXPECT_TRUE(readWith(whole.substr(0, at)).empty()) << "cut at " << at;
    }
    EXPECT_TRUE(readWith(whole + "x").empty());
    ASSERT_TRUE(writePipelineCache(file, someKey(), someData(5)));
    EXPECT_EQ(readPipelineCache(file, someKey()), someData(5));
}

// With any umask, the written file can be read again, and nobody else can write to it.
TEST(PipelineCache, AFileIsOfThisUserAlone) {
    const fs::path file = folder() / "made" / "pipelines";
    const mode_t before = ::umask(0);
    const bool written = writePipelineCache(file, someKey(), someData(100));
    ::umask(before);
    ASSERT_TRUE(written);
    EXPECT_EQ(readPipelineCache(file, someKey()), someData(100));
    fs::permissions(file, fs::perms::group_write, fs::perm_options::add);
    EXPECT_TRUE(readPipelineCache(file, someKey()).empty());
}

TEST(PipelineCache, WhatCannotBeWrittenIsNoError) {
    const fs::path target = folder();
    std::ofstream(target / "file") << "no folder";
    EXPECT_FALSE(writePipelineCache(target / "file" / "pipelines", someKey(), someData(5)));
    fs::create_directory(target / "pipelines");
    EXPECT_FALSE(writePipelineCache(target / "pipelines", someKey(), someData(5)));
    EXPECT_TRUE(readPipelineCache(target / "pipelines", someKey()).empty());
    EXPECT_EQ(namesIn(target), (std::vector<std::string>{"file", "pipelines"})) << "a temporary file stays";
}

TEST(PipelineCache, TheFolderIsTheUsersAsTheXdgSpecificationHasIt) {
    const Variable home("HOME", "/users/one");
    {
        const Variable cache("XDG_CACHE_HOME", "/cache");
        EXPECT_EQ(userCacheFolder(), fs::path("/cache/diptych"));
    }
    for (const char* ignored : {"", "relative", static_cast<const char*>(nullptr)}) {
        const Variable cache("XDG_CACHE_HOME", ignored);
        EXPECT_EQ(userCacheFolder(), fs::path("/users/one/.cache/diptych"));
        const Variable nowhere("HOME", nullptr);
        EXPECT_EQ(userCacheFolder(), fs::path());
    }
}
