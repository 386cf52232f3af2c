// SPDX-License-Identifier: MIT
// Moving files into a folder together, and recovery after the program was killed.
#include "compare/files/file_moves.h"

#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <sys/stat.h>

#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

void put(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

// Moves files with these names and the content "new" into the folder.
void moveNew(const fs::path& target, const FileMoves& moves) {
    Temporary made(target, "report");
    ASSERT_TRUE(made.createFolder());
    for (const std::string& name : moves.files) put(made.path() / name, "new");
    moveFiles(target, made, moves);
}

// The folder after a program was killed once its files were complete: all of `there`, and a list.
void begin(const fs::path& target, const Names& there, const std::string& list) {
    for (const std::string& name : there) put(target / ".diptych.put" / name, "new");
    put(target / ".diptych.put" / ".plan.json", list);
}

TEST(FileMoves, TakeTheirPlacesAndThoseOfEarlierOnesAlone) {
    const fs::path target = folder();
    for (const char* name : {"lit.png", "1/lit.png", "2/lit.png", "2/notes.txt", "notes.txt"})
        put(target / name, "old");
    moveNew(target, {{"lit.png", "3/lit.png"}, {"lit.png", "1/lit.png", "2/lit.png", "away.png"}});
    EXPECT_EQ(namesIn(target), (Names{"2", "3", "lit.png", "notes.txt"})) << "nor are emptied folders left";
    EXPECT_EQ(namesIn(target / "2"), Names{"notes.txt"});
    EXPECT_EQ(contentsOf(target / "lit.png"), "new");
    EXPECT_EQ(contentsOf(target / "3/lit.png"), "new");
    EXPECT_EQ(contentsOf(target / "notes.txt"), "old");
    EXPECT_FALSE(isMoveBegun(target));
}

// A file blocks the last file's folder, so the first files are moved back.
TEST(FileMoves, AreUndoneWhereOneFails) {
    const fs::path target = folder();
    put(target / "lit.png", "old");
    put(target / "0", "in the way");
    put(target / "index.html", "old");
    EXPECT_THROW(moveNew(target, {{"lit.png", "depth.png", "0/lit.png"}, {"index.html"}}),
                 std::runtime_error);
    EXPECT_EQ(namesIn(target), (Names{"0", "index.html", "lit.png"}));
    EXPECT_EQ(contentsOf(target / "lit.png"), "old");
    EXPECT_EQ(contentsOf(target / "0"), "in the way");
    EXPECT_EQ(contentsOf(target / "index.html"), "old");
}

TEST(FileMoves, OfAKilledProgramAreFinished) {
    const fs::path target = folder();
    put(target / "old.png", "old");
    put(target / "1/old.png", "old");
    put(target / "lit.png", "old");
    put(target / "depth.png", "new");  // moved before the program was killed
    begin(target, {"lit.png"}, R"({"files": ["depth.png", "lit.png"],
                                  "earlier": ["old.png", "1/old.png", "lit.png"]})");
    EXPECT_TRUE(isMoveBegun(target));
    finishMoves(target);
    EXPECT_FALSE(isMoveBegun(target));
    EXPECT_EQ(namesIn(target), (Names{"depth.png", "lit.png"}));
    EXPECT_EQ(contentsOf(target / "lit.png"), "new");
    finishMoves(target);
    EXPECT_EQ(namesIn(target), (Names{"depth.png", "lit.png"})) << "nothing is left to be finished";
}

// An edited list neither adds nor removes files that diptych does not write.
TEST(FileMoves, AListNamesOurFilesAlone) {
    const fs::path above = folder(), target = above / "report";
    put(above / "beside.png", "old");
    put(target / "notes.txt", "old");
    put(target / ".hidden.png", "old");
    put(above / "aside.png", "old");
    put(target / "earlier/lit.png", "old");
    begin(target, {"lit.png", "run.sh"}, R"({"files": ["lit.png", "run.sh", "../new.png", 7],
              "earlier": ["../beside.png", "notes.txt", ".hidden.png", "earlier/../../aside.png",
              "earlier/lit.png"]})");
    put(target / "new.png", "old");
    finishMoves(target);
    EXPECT_EQ(contentsOf(target / "lit.png"), "new");
    EXPECT_TRUE(fs::exists(above / "beside.png"));
    EXPECT_TRUE(fs::exists(target / "notes.txt"));
    EXPECT_TRUE(fs::exists(target / ".hidden.png"));
    EXPECT_TRUE(fs::exists(above / "aside.png"));
    EXPECT_FALSE(fs::exists(target / "earlier/lit.png")) << "a scene's folder is ours";
    EXPECT_FALSE(fs::exists(target / "run.sh"));
    EXPECT_TRUE(fs::exists(target / "new.png"));
    EXPECT_FALSE(fs::exists(above / "new.png"));
}

// Links planted in a folder that is not ours are refused.
void expectRefused(const fs::path& target, const fs::path& named) {
    const std::string refusal = faultOf([&] { finishMoves(target); });
    EXPECT_EQ(refusal.find(named.string() + ": "), 0u) << refusal;
}

TEST(FileMoves, ALinkInPlaceOfWhatWasBegunIsRefused) {
    const fs::path above = folder(), target = above / "report", elsewhere = above / "elsewhere";
    fs::create_directories(target);
    put(elsewhere / "lit.png", "theirs");
    put(elsewhere / "inner/kept.txt", "theirs");
    put(elsewhere / ".plan.json", R"({"files": ["lit.png"]})");
    fs::create_directory_symlink(elsewhere, target / ".diptych.put");
    expectRefused(target, target / ".diptych.put");
    EXPECT_EQ(filesIn(elsewhere), (Names{".plan.json", "inner/kept.txt", "lit.png"}));
    EXPECT_EQ(namesIn(target), Names{".diptych.put"});
    EXPECT_THROW(moveNew(target, {{"lit.png"}, {}}), std::runtime_error);
    EXPECT_EQ(contentsOf(elsewhere / "lit.png"), "theirs");
}

TEST(FileMoves, AFolderThatIsALinkIsNeitherFilledNorEmptied) {
    const fs::path above = folder(), target = above / "report", elsewhere = above / "elsewhere";
    fs::create_directories(target);
    for (const char* name : {"lit.png", "old.png"}) put(elsewhere / name, "theirs");
    fs::create_directory_symlink(elsewhere, target / "1");
    begin(target, {"1/lit.png"}, R"({"files": ["1/lit.png"], "earlier": ["1/old.png"]})");
    expectRefused(target, target / "1");
    fs::remove_all(target / ".diptych.put");
    EXPECT_THROW(moveNew(target, {{"0/lit.png", "1/lit.png"}, {"1/old.png"}}), std::runtime_error);
    EXPECT_EQ(namesIn(target), Names{"1"}) << "all is undone";
    moveNew(target, {{"lit.png"}, {"1/old.png"}});
    EXPECT_EQ(namesIn(target), (Names{"1", "lit.png"}));
    for (const char* name : {"lit.png", "old.png"}) EXPECT_EQ(contentsOf(elsewhere / name), "theirs");
}

TEST(FileMoves, LinksInPlaceOfFilesAreReplaced) {
    const fs::path above = folder(), target = above / "report", elsewhere = above / "elsewhere";
    fs::create_directories(target);
    put(elsewhere / "file", "theirs");
    put(elsewhere / "inner/file", "theirs");
    fs::create_symlink(elsewhere / "file", target / "lit.png");
    moveNew(target, {{"lit.png"}, {}});
    EXPECT_EQ(contentsOf(target / "lit.png"), "new");
    // Leftovers removed with a finished list.
    begin(target, {"lit.png"}, R"({"files": ["lit.png"]})");
    fs::create_directory_symlink(elsewhere, target / ".diptych.put/.old");
    fs::create_directories(target / ".diptych.put/1");
    fs::create_directory_symlink(elsewhere, target / ".diptych.put/1/inner");
    finishMoves(target);
    EXPECT_EQ(namesIn(target), Names{"lit.png"});
    EXPECT_EQ(filesIn(elsewhere), (Names{"file", "inner/file"}));
    EXPECT_EQ(contentsOf(elsewhere / "file"), "theirs");
}

TEST(FileMoves, AListIsARegularFile) {
    for (const bool isPipe : {false, true}) {
        const fs::path above = folder(), target = above / "report", list = target / ".diptych.put/.plan.json";
        put(above / "list", R"({"files": ["lit.png"]})");
        put(target / ".diptych.put/lit.png", "new");
        if (isPipe)
            ASSERT_EQ(::mkfifo(list.c_str(), 0600), 0);
        else
            fs::create_symlink(above / "list", list);
        expectRefused(target, list);
        EXPECT_FALSE(fs::exists(target / "lit.png"));
    }
}

TEST(FileMoves, AListThatCannotBeReadIsNamed) {
    for (const char* list : {"", "[]", R"({"earlier": []})"}) {
        const fs::path target = folder();
        begin(target, {"lit.png"}, list);
        const std::string refusal = faultOf([&] { finishMoves(target); });
        EXPECT_EQ(refusal, (target / ".diptych.put/.plan.json").string() +
                               ": left by an interrupted run and unreadable; remove its folder");
        EXPECT_TRUE(fs::exists(target / ".diptych.put/lit.png"));
    }
}

}  // namespace
}  // namespace diptych
