// SPDX-License-Identifier: MIT
// Moving files into a folder together, and recovery after the program was killed.
#include "compare/files/file_moves.h"

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
void moveNew(const fs::path& place, const FileMoves& moves) {
    Temporary made(place, "report");
    ASSERT_TRUE(made.createFolder());
    for (const std::string& name : moves.files) put(made.path() / name, "new");
    moveFiles(place, made, moves);
}

// The folder after a program was killed once its files were complete: all of `there`, and a list.
void begin(const fs::path& place, const Names& there, const std::string& list) {
    for (const std::string& name : there) put(place / ".diptych.put" / name, "new");
    put(place / ".diptych.put" / ".plan.json", list);
}

TEST(FileMoves, TakeTheirPlacesAndThoseOfEarlierOnesAlone) {
    const fs::path place = folder();
    for (const char* name : {"lit.png", "1/lit.png", "2/lit.png", "2/notes.txt", "notes.txt"})
        put(place / name, "old");
    moveNew(place, {{"lit.png", "3/lit.png"}, {"lit.png", "1/lit.png", "2/lit.png", "away.png"}});
    EXPECT_EQ(namesIn(place), (Names{"2", "3", "lit.png", "notes.txt"})) << "nor are emptied folders left";
    EXPECT_EQ(namesIn(place / "2"), Names{"notes.txt"});
    EXPECT_EQ(contentsOf(place / "lit.png"), "new");
    EXPECT_EQ(contentsOf(place / "3/lit.png"), "new");
    EXPECT_EQ(contentsOf(place / "notes.txt"), "old");
    EXPECT_FALSE(isMoveBegun(place));
}

// A file blocks the last file's folder, so the first files are moved back.
TEST(FileMoves, AreUndoneWhereOneFails) {
    const fs::path place = folder();
    put(place / "lit.png", "old");
    put(place / "0", "in the way");
    put(place / "index.html", "old");
    EXPECT_THROW(moveNew(place, {{"lit.png", "depth.png", "0/lit.png"}, {"index.html"}}), std::runtime_error);
    EXPECT_EQ(namesIn(place), (Names{"0", "index.html", "lit.png"}));
    EXPECT_EQ(contentsOf(place / "lit.png"), "old");
    EXPECT_EQ(contentsOf(place / "0"), "in the way");
    EXPECT_EQ(contentsOf(place / "index.html"), "old");
}

TEST(FileMoves, OfAKilledProgramAreFinished) {
    const fs::path place = folder();
    put(place / "old.png", "old");
    put(place / "1/old.png", "old");
    put(place / "lit.png", "old");
    put(place / "depth.png", "new");  // moved before the program was killed
    begin(place, {"lit.png"}, R"({"files": ["depth.png", "lit.png"],
                                  "earlier": ["old.png", "1/old.png", "lit.png"]})");
    EXPECT_TRUE(isMoveBegun(place));
    finishMoves(place);
    EXPECT_FALSE(isMoveBegun(place));
    EXPECT_EQ(namesIn(place), (Names{"depth.png", "lit.png"}));
    EXPECT_EQ(contentsOf(place / "lit.png"), "new");
    finishMoves(place);
    EXPECT_EQ(namesIn(place), (Names{"depth.png", "lit.png"})) << "nothing is left to be finished";
}

// An edited list neither adds nor removes files that diptych does not write.
TEST(FileMoves, AListNamesOurFilesAlone) {
    const fs::path above = folder(), place = above / "report";
    put(above / "beside.png", "old");
    put(place / "notes.txt", "old");
    put(place / ".hidden.png", "old");
    put(above / "aside.png", "old");
    put(place / "earlier/lit.png", "old");
    begin(place, {"lit.png", "run.sh"}, R"({"files": ["lit.png", "run.sh", "../new.png", 7],
              "earlier": ["../beside.png", "notes.txt", ".hidden.png", "earlier/../../aside.png",
              "earlier/lit.png"]})");
    put(place / "new.png", "old");
    finishMoves(place);
    EXPECT_EQ(contentsOf(place / "lit.png"), "new");
    EXPECT_TRUE(fs::exists(above / "beside.png"));
    EXPECT_TRUE(fs::exists(place / "notes.txt"));
    EXPECT_TRUE(fs::exists(place / ".hidden.png"));
    EXPECT_TRUE(fs::exists(above / "aside.png"));
    EXPECT_FALSE(fs::exists(place / "earlier/lit.png")) << "a scene's folder is ours";
    EXPECT_FALSE(fs::exists(place / "run.sh"));
    EXPECT_TRUE(fs::exists(place / "new.png"));
    EXPECT_FALSE(fs::exists(above / "new.png"));
}

// Links planted in a folder that is not ours are refused.
void expectRefused(const fs::path& place, const fs::path& named) {
    try {
        finishMoves(place);
        ADD_FAILURE() << named;
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()).find(named.string() + ": "), 0u) << error.what();
    }
}

TEST(FileMoves, ALinkInPlaceOfWhatWasBegunIsRefused) {
    const fs::path above = folder(), place = above / "report", elsewhere = above / "elsewhere";
    fs::create_directories(place);
    put(elsewhere / "lit.png", "theirs");
    put(elsewhere / "inner/kept.txt", "theirs");
    put(elsewhere / ".plan.json", R"({"files": ["lit.png"]})");
    fs::create_directory_symlink(elsewhere, place / ".diptych.put");
    expectRefused(place, place / ".diptych.put");
    EXPECT_EQ(filesIn(elsewhere), (Names{".plan.json", "inner/kept.txt", "lit.png"}));
    EXPECT_EQ(namesIn(place), Names{".diptych.put"});
    EXPECT_THROW(moveNew(place, {{"lit.png"}, {}}), std::runtime_error);
    EXPECT_EQ(contentsOf(elsewhere / "lit.png"), "theirs");
}

TEST(FileMoves, AFolderThatIsALinkIsNeitherFilledNorEmptied) {
    const fs::path above = folder(), place = above / "report", elsewhere = above / "elsewhere";
    fs::create_directories(place);
    for (const char* name : {"lit.png", "old.png"}) put(elsewhere / name, "theirs");
    fs::create_directory_symlink(elsewhere, place / "1");
    begin(place, {"1/lit.png"}, R"({"files": ["1/lit.png"], "earlier": ["1/old.png"]})");
    expectRefused(place, place / "1");
    fs::remove_all(place / ".diptych.put");
    EXPECT_THROW(moveNew(place, {{"0/lit.png", "1/lit.png"}, {"1/old.png"}}), std::runtime_error);
    EXPECT_EQ(namesIn(place), Names{"1"}) << "all is undone";
    moveNew(place, {{"lit.png"}, {"1/old.png"}});
    EXPECT_EQ(namesIn(place), (Names{"1", "lit.png"}));
    for (const char* name : {"lit.png", "old.png"}) EXPECT_EQ(contentsOf(elsewhere / name), "theirs");
}

TEST(FileMoves, LinksInPlaceOfFilesAreReplaced) {
    const fs::path above = folder(), place = above / "report", elsewhere = above / "elsewhere";
    fs::create_directories(place);
    put(elsewhere / "file", "theirs");
    put(elsewhere / "inner/file", "theirs");
    fs::create_symlink(elsewhere / "file", place / "lit.png");
    moveNew(place, {{"lit.png"}, {}});
    EXPECT_EQ(contentsOf(place / "lit.png"), "new");
    // Leftovers removed with a finished list.
    begin(place, {"lit.png"}, R"({"files": ["lit.png"]})");
    fs::create_directory_symlink(elsewhere, place / ".diptych.put/.old");
    fs::create_directories(place / ".diptych.put/1");
    fs::create_directory_symlink(elsewhere, place / ".diptych.put/1/inner");
    finishMoves(place);
    EXPECT_EQ(namesIn(place), Names{"lit.png"});
    EXPECT_EQ(filesIn(elsewhere), (Names{"file", "inner/file"}));
    EXPECT_EQ(contentsOf(elsewhere / "file"), "theirs");
}

TEST(FileMoves, AListIsARegularFile) {
    for (const bool isPipe : {false, true}) {
        const fs::path above = folder(), place = above / "report", list = place / ".diptych.put/.plan.json";
        put(above / "list", R"({"files": ["lit.png"]})");
        put(place / ".diptych.put/lit.png", "new");
        if (isPipe)
            ASSERT_EQ(::mkfifo(list.c_str(), 0600), 0);
        else
            fs::create_symlink(above / "list", list);
        expectRefused(place, list);
        EXPECT_FALSE(fs::exists(place / "lit.png"));
    }
}

TEST(FileMoves, AListThatCannotBeReadIsNamed) {
    for (const char* list : {"", "[]", R"({"earlier": []})"}) {
        const fs::path place = folder();
        begin(place, {"lit.png"}, list);
        try {
            finishMoves(place);
            ADD_FAILURE() << list;
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(std::string(error.what()),
                      (place / ".diptych.put/.plan.json").string() +
                          ": left by an interrupted run and unreadable; remove its folder");
        }
        EXPECT_TRUE(fs::exists(place / ".diptych.put/lit.png"));
    }
}

}  // namespace
}  // namespace diptych
