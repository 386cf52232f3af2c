// SPDX-License-Identifier: MIT
// Rewriting a folder keeps its mode, its attributes and links to it.
#include "compare/files/output_folder.h"
#include "compare/files/checkpoint_folder.h"
#include "compare/shards/slurm.h"
#include "shared/image/atomic_file.h"
#include "shared/image/exr.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <functional>

namespace diptych {
namespace {

namespace fs = std::filesystem;

// Rewrites the single file a.txt and returns the folder's inode before and after.
std::pair<ino_t, ino_t> inodesAround(const fs::path& target, const std::string& text) {
    struct stat before {
    }, after{};
    EXPECT_EQ(::stat(target.c_str(), &before), 0);
    {
        OutputFolder output(target);
        std::ofstream(output / "a.txt") << text;
        output.put({"a.txt"}, [] { return std::vector<std::string>{"a.txt"}; });
    }
    EXPECT_EQ(::stat(target.c_str(), &after), 0);
    EXPECT_EQ(contentsOf(target / "a.txt"), text);
    EXPECT_EQ(namesIn(target), std::vector<std::string>{"a.txt"});
    EXPECT_EQ(before.st_mode, after.st_mode);
    return {before.st_ino, after.st_ino};
}

TEST(OutputFolder, IsExchangedAsAWholeWithItsMode) {
    const fs::path target = folder() / "report";
    fs::create_directory(target);
    std::ofstream(target / "a.txt") << "old";
    ASSERT_EQ(::chmod(target.c_str(), 0750), 0);
    const auto [before, after] = inodesAround(target, "new");
    EXPECT_NE(before, after) << "the control of the tests below: a folder of ours alone is exchanged";
}

TEST(OutputFolder, KeepsItsExtendedAttributes) {
    const fs::path target = folder() / "report";
    fs::create_directory(target);
    std::ofstream(target / "a.txt") << "old";
    if (::setxattr(target.c_str(), "user.note", "kept", 4, 0) != 0)
        GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: no extended attributes of users in " << target;
    const auto [before, after] = inodesAround(target, "new");
    EXPECT_EQ(before, after);
    char value[8];
    EXPECT_EQ(::getxattr(target.c_str(), "user.note", value, sizeof value), 4);
}

TEST(OutputFolder, ALinkStaysALink) {
    const fs::path home = folder(), target = home / "report";
    fs::create_directory(target);
    std::ofstream(target / "a.txt") << "old";
    fs::create_symlink("report", home / "latest");
    inodesAround(home / "latest", "new");
    EXPECT_TRUE(fs::is_symlink(home / "latest"));
    EXPECT_EQ(contentsOf(target / "a.txt"), "new");
    if (::lchown((home / "latest").c_str(), 65534, 65534) != 0)
        GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: not root";
    EXPECT_THROW(OutputFolder(home / "latest"), std::runtime_error) << "another user's link";
}

// Links planted in the folder, and under the names of a killed program's temporary files.
TEST(OutputFolder, LinksInsideAreNotFollowed) {
    const fs::path home = folder(), target = home / "report", elsewhere = home / "elsewhere";
    fs::create_directory(target);
    fs::create_directory(elsewhere);
    std::ofstream(elsewhere / "lit.png") << "theirs";
    for (const fs::path& in : {home, target}) {
        fs::create_directory_symlink(elsewhere, in / ".report.99999999-0.tmp");
        fs::create_directory(in / ".report.99999999-1.tmp");
        fs::create_directory_symlink(elsewhere, in / ".report.99999999-1.tmp/inner");
    }
    fs::create_directory_symlink(elsewhere, target / "1");
    const auto put = [&](const std::vector<std::string>& files) {
        OutputFolder output(target);
        output.makeFolders(files);
        for (const std::string& file : files) std::ofstream(output / file) << "new";
        output.put(files, [] { return std::vector<std::string>{"1/lit.png"}; });
    };
    EXPECT_THROW(put({"a.txt", "1/lit.png"}), std::runtime_error);
    EXPECT_EQ(namesIn(target), (std::vector<std::string>{".report.99999999-0.tmp", "1"}));
    put({"a.txt"});
    EXPECT_EQ(contentsOf(target / "a.txt"), "new");
    EXPECT_EQ(filesIn(elsewhere), std::vector<std::string>{"lit.png"});
    EXPECT_EQ(contentsOf(elsewhere / "lit.png"), "theirs");
}

// The checkpoint folder beside an output, used by a long command.
TEST(CheckpointFolder, ALinkIsRefusedAndItsFolderKept) {
    const fs::path home = folder(), elsewhere = home / "elsewhere";
    fs::create_directory(elsewhere);
    std::ofstream(elsewhere / "mine.txt") << "mine";
    std::ofstream(elsewhere / "key.json") << R"({"software": "diptych", "schema": 1})";
    fs::create_directory_symlink("elsewhere", home / ".r.scenes");
    const std::string refusal = faultOf([&] {
        const CheckpointFolder kept(home / "r", "scenes",
                                    {{"software", "diptych"}, {"schema", 1}, {"of", "me"}});
    });
    EXPECT_NE(refusal.find(".r.scenes: is a symbolic link"), std::string::npos) << refusal;
    EXPECT_EQ(namesIn(elsewhere), (std::vector<std::string>{"key.json", "mine.txt"}));
}

TEST(CheckpointFolder, LinksInItAreReplacedAndNotFollowed) {
    const fs::path home = folder();
    std::ofstream(home / "mine.json") << "mine";
    std::ofstream(home / "inner.txt") << "mine";
    const nlohmann::ordered_json key{{"software", "diptych"}, {"schema", 1}};
    CheckpointFolder kept(home / "r", "scenes", key);
    fs::create_symlink(home / "mine.json", kept / "part.json");
    kept.keep("part", {{"of", "ours"}});
    EXPECT_EQ(contentsOf(home / "mine.json"), "mine");
    EXPECT_EQ(kept.find("part")["of"], "ours");
    fs::create_directory_symlink(home, kept / "folder");
    kept.remove();
    EXPECT_EQ(namesIn(home), (std::vector<std::string>{"inner.txt", "mine.json"}));
}

// A resumed command writes into the scene folders that it finds there.
TEST(CheckpointFolder, LinksInOneThatIsGoneOnWithAreRemoved) {
    const fs::path home = folder(), elsewhere = home / "elsewhere";
    fs::create_directory(elsewhere);
    std::ofstream(elsewhere / "part.json") << "{}";
    const nlohmann::ordered_json key{{"software", "diptych"}, {"schema", 1}};
    {
        const CheckpointFolder kept(home / "r", "scenes", key);
        kept.keep("part", {{"of", "ours"}});
        fs::create_directory(kept / "Box");
        fs::create_directory_symlink(elsewhere, kept / "Sphere");
        fs::create_directory_symlink(elsewhere, kept / "Box/top");
        fs::create_symlink(elsewhere / "part.json", kept / "theirs.json");
    }
    const CheckpointFolder again(home / "r", "scenes", key);
    EXPECT_EQ(filesIn(again.path()), (std::vector<std::string>{"key.json", "part.json"}));
    EXPECT_FALSE(again.isRenewed());
    EXPECT_EQ(filesIn(elsewhere), std::vector<std::string>{"part.json"});
}

// Another program renames a folder and puts a link to `elsewhere`, with a file under each name, in its place.
void replaceByLink(const fs::path& folder, const fs::path& elsewhere) {
    fs::create_directories(elsewhere / "1");
    for (const char* name : {"a.txt", "part.json", "lit.exr", "1/lit.png"})
        std::ofstream(elsewhere / name) << "theirs";
    fs::rename(folder, folder.string() + ".aside");
    fs::create_directory_symlink(elsewhere, folder);
}

void expectUntouched(const fs::path& elsewhere) {
    const std::vector<std::string> names{"1/lit.png", "a.txt", "lit.exr", "part.json"};
    EXPECT_EQ(filesIn(elsewhere), names);
    for (const std::string& name : names) EXPECT_EQ(contentsOf(elsewhere / name), "theirs") << name;
}

void fill(const OutputFolder& output) {
    output.makeFolders({"1/lit.png", "2/lit.png"});
    writeFile(output / "a.txt", "ours");
    writeFile(output / "1/lit.png", "ours");
    const Image image(1, 1, 1, 1.0f);
    writeExr(output / "lit.exr", {{{"Y"}, &image}});
    copyBelow(output.path(), "a.txt", output / "2/lit.png");
    linkOrCopy(output.path(), "a.txt", output / "part.json");
}

TEST(OutputFolder, IsWrittenPutAndRemovedByItsDescriptor) {
    for (const bool exists : {false, true}) {
        const fs::path home = folder(), elsewhere = home / "elsewhere";
        if (exists) fs::create_directory(home / "report");
        {
            OutputFolder output(home / "report");
            replaceByLink(output.path(), elsewhere);
            fill(output);
            EXPECT_EQ(filesIn(output.path().string() + ".aside").size(), 5u) << "it stays in its folder";
            const auto none = [] { return std::vector<std::string>(); };
            EXPECT_THROW(output.put({"a.txt"}, none), std::runtime_error);
        }
        expectUntouched(elsewhere);
        EXPECT_EQ(filesIn(home).size(), 4u) << "what was written is removed";
    }
}

TEST(OutputFolder, AFolderInsideIsNotWrittenThroughALink) {
    const fs::path home = folder(), elsewhere = home / "elsewhere";
    OutputFolder output(home / "report");
    output.makeFolders({"1/lit.png"});
    replaceByLink(output / "1", elsewhere);
    EXPECT_THROW(writeFile(output / "1/a.txt", "ours"), std::runtime_error);
    EXPECT_THROW(output.makeFolders({"1/top/lit.png"}), std::runtime_error);
    EXPECT_THROW(linkOrCopy(elsewhere, "a.txt", output / "1/b.txt"), std::runtime_error);
    expectUntouched(elsewhere);
}

// An earlier folder that another program replaces during the run; and files of its successor.
TEST(OutputFolder, OneThatTookItsNameIsNotChanged) {
    const fs::path home = folder(), target = home / "report", elsewhere = home / "elsewhere";
    fs::create_directory(target);
    std::ofstream(target / "a.txt") << "old";
    OutputFolder output(target);
    writeFile(output / "a.txt", "new");
    replaceByLink(target, elsewhere);
    const auto earlier = [] { return std::vector<std::string>{"a.txt", "part.json"}; };
    EXPECT_THROW(output.put({"a.txt"}, earlier), std::runtime_error);
    expectUntouched(elsewhere);
    fs::remove(target);
    fs::rename(elsewhere, target);
    EXPECT_THROW(output.put({"a.txt"}, earlier), std::runtime_error);
    expectUntouched(target);
}

TEST(CheckpointFolder, IsWrittenReadAndRemovedByItsDescriptor) {
    const fs::path home = folder(), elsewhere = home / "elsewhere";
    CheckpointFolder kept(home / "r", "scenes", {{"software", "diptych"}, {"schema", 1}});
    replaceByLink(kept.path(), elsewhere);
    kept.keep("part", {{"of", "ours"}});
    writeFile(kept / "a.txt", "ours");
    EXPECT_EQ(kept.find("part")["of"], "ours");
    expectUntouched(elsewhere);
    kept.remove();
    expectUntouched(elsewhere);
    EXPECT_EQ(filesIn(home).size(), 4u) << "its files are removed";
}

// Folders under the names of ours that other users could change. Nothing in them is changed.
void expectForeignIsRefused(const fs::path& there, const std::function<void()>& use) {
    fs::create_directories(there);
    std::ofstream(there / "key.json") << R"({"software": "diptych", "schema": 1})";
    std::ofstream(there / ".plan.json") << R"({"files": [], "earlier": ["index.html"]})";
    fs::create_symlink("key.json", there / "link.json");
    const auto expectRefused = [&](const char* why) {
        const std::string refusal = faultOf([&] { use(); });
        EXPECT_EQ(refusal.find(there.string() + ": " + why), 0u) << refusal;
        EXPECT_EQ(namesIn(there), (std::vector<std::string>{".plan.json", "key.json", "link.json"}));
    };
    for (const mode_t mode : {0775, 0757, 01777}) {
        ASSERT_EQ(::chmod(there.c_str(), mode), 0);
        expectRefused("other users may write to it; run chmod go-w on it");
    }
    ASSERT_EQ(::chmod(there.c_str(), 0755), 0);
    if (::chown(there.c_str(), 65534, 65534) != 0) GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: not root";
    expectRefused("it belongs to another user");
    for (const auto& entry : fs::directory_iterator(there)) fs::remove(entry);
}

TEST(CheckpointFolder, AForeignOneIsRefusedUnchanged) {
    const fs::path home = folder(), there = home / ".r.scenes";
    const auto use = [&] {
        CheckpointFolder(home / "r", "scenes", {{"software", "diptych"}, {"schema", 1}, {"of", "me"}});
    };
    expectForeignIsRefused(there, use);
    if (testing::Test::IsSkipped()) return;
    EXPECT_THROW(use(), std::runtime_error) << "an empty one, too";
}

TEST(OutputFolder, ForeignMovesAreNotFinished) {
    const fs::path home = folder();
    std::ofstream(home / "index.html") << "mine";
    expectForeignIsRefused(home / ".diptych.put", [&] { finishOutput(home); });
    EXPECT_EQ(contentsOf(home / "index.html"), "mine");
}

TEST(OutputFolder, ForeignJobsAreRefused) {
    const fs::path home = folder();
    expectForeignIsRefused(home / "r.slurm", [&] {
        shards::submit({.program = "/bin/false",
                        .working = home,
                        .words = {"compare"},
                        .out = home / "r",
                        .options = {}});
    });
}

// A run may be resumed whatever the umask.
TEST(CheckpointFolder, IsResumedWithAnyUmask) {
    const fs::path home = folder();
    const mode_t before = ::umask(0);
    for (int i = 0; i < 2; ++i) {
        const CheckpointFolder kept(home / "r", "scenes", {{"software", "diptych"}, {"schema", 1}});
        EXPECT_EQ(kept.find("part").is_null(), i == 0);
        kept.keep("part", {{"of", "ours"}});
    }
    OutputFolder output(home / "r");
    output.put({}, [] { return std::vector<std::string>(); });
    ::umask(before);
    EXPECT_EQ(fs::status(home / "r").permissions(), fs::perms::all) << "an output has the mode of the umask";
}

// Folders that belong to another, below a parent where anybody may rename things.
TEST(OutputFolder, AFolderOfAnotherIsWritten) {
    const fs::path home = folder(), target = home / "report";
    fs::create_directory(target);
    ASSERT_EQ(::chmod(home.c_str(), 0777), 0);
    if (::chown(target.c_str(), 65534, 65534) != 0) GTEST_SKIP() << "SKIPPED, NOT PROVED HERE: not root";
    for (const char* text : {"old", "new"}) {
        OutputFolder output(target);
        writeFile(output / "a.txt", text);
        output.put({"a.txt"}, [] { return std::vector<std::string>{"a.txt"}; });
        EXPECT_EQ(contentsOf(target / "a.txt"), text);
        EXPECT_EQ(namesIn(target), std::vector<std::string>{"a.txt"});
    }
}

// Where anybody may rename things, a folder of ours may get the name of a leftover.
TEST(OutputFolder, WhatOthersMayHaveRenamedIsNotSwept) {
    const fs::path home = folder(), leftover = home / ".report.99999999-0.tmp";
    ASSERT_EQ(::chmod(home.c_str(), 0777), 0);
    for (const mode_t mode : {0755, 01700}) {
        fs::create_directories(leftover);
        std::ofstream(leftover / "thesis.txt") << "years of work";
        ASSERT_EQ(::chmod(leftover.c_str(), mode), 0);
        const OutputFolder output(home / "report");
        EXPECT_EQ(fs::exists(leftover), mode == 0755) << "with the mode of a temporary folder it is one";
    }
}

// Fails before looking for sbatch.
TEST(OutputFolder, ScriptsOfJobsAreNotPutThroughALink) {
    const fs::path home = folder(), elsewhere = home / "elsewhere";
    fs::create_directory(elsewhere);
    fs::create_directory_symlink(elsewhere, home / "r.slurm");
    EXPECT_THROW(shards::submit({.program = "/bin/false",
                                 .working = home,
                                 .words = {"compare"},
                                 .out = home / "r",
                                 .options = {}}),
                 std::runtime_error);
    EXPECT_EQ(namesIn(elsewhere), std::vector<std::string>());
}

}  // namespace
}  // namespace diptych
