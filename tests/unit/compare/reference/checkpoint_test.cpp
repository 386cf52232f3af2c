// SPDX-License-Identifier: MIT
#include "compare/reference/checkpoint.h"

#include "tests/support/campaign.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <stdexcept>

namespace diptych::reference {
namespace {

using Path = std::filesystem::path;
using Names = std::vector<std::string>;

const std::vector<float> firstValues{1, 2, 3}, secondValues{4, 5, 6};
constexpr std::uint64_t key = 0x0123456789abcdefu, other_key = 0xfedcba9876543210u;
constexpr const char *keptName = "kept-01234567", *other_name = "kept-fedcba98";

void write(const Path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

// Two records of three floats in an empty folder; returns the stem.
Path twoRecords() {
    const Path stem = folder() / "kept";
    Checkpoint checkpoint(stem, key, 3);
    EXPECT_TRUE(checkpoint.takeEarlier().empty());
    EXPECT_EQ(checkpoint.file(), stem.parent_path() / keptName);
    checkpoint.keep(10, firstValues);
    checkpoint.keep(11, secondValues);
    return stem;
}

std::vector<std::uint64_t> numbersIn(Checkpoint& checkpoint) {
    std::vector<std::uint64_t> numbers;
    for (const Checkpoint::Record& record : checkpoint.takeEarlier()) {
        EXPECT_EQ(record.values, record.index == 10 ? firstValues : secondValues);
        numbers.push_back(record.index);
    }
    return numbers;
}

std::vector<std::uint64_t> numbersAt(const Path& stem, std::uint64_t of = key, std::size_t floats = 3) {
    Checkpoint checkpoint(stem, of, floats);
    return numbersIn(checkpoint);
}

using Numbers = std::vector<std::uint64_t>;

TEST(ReferenceCheckpoint, HoldsWhatIsKept) {
    const Path stem = twoRecords();
    EXPECT_EQ(numbersAt(stem), (Numbers{10, 11}));
    EXPECT_EQ(numbersAt(stem), (Numbers{10, 11})) << "reading changes nothing";
}

TEST(ReferenceCheckpoint, WhereverTheFileEndsWhatIsWholeCounts) {
    const Path stem = twoRecords(), file = stem.parent_path() / keptName;
    const std::string bytes = contentsOf(file);
    const std::size_t record = 8 + 3 * 4 + 8, head = bytes.size() - 2 * record;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        write(file, bytes.substr(0, size));
        const std::size_t whole = size < head ? 0 : (size - head) / record;
        EXPECT_EQ(numbersAt(stem).size(), whole) << size;
        if (size < head) continue;
        // Writing continues after the valid records.
        write(file, bytes.substr(0, size));
        {
            Checkpoint checkpoint(stem, key, 3);
            if (whole == 0) checkpoint.keep(10, firstValues);
            checkpoint.keep(11, secondValues);
        }
        EXPECT_EQ(numbersAt(stem), (Numbers{10, 11})) << size;
    }
}

// All in a campaign, otherwise one or two of each byte.
TEST(ReferenceCheckpoint, EveryBitCounts) {
    const Path stem = twoRecords(), file = stem.parent_path() / keptName;
    const std::string bytes = contentsOf(file);
    const Rows rows(5);
    for (int bit = 0; bit < static_cast<int>(bytes.size() * 8); bit = rows.after(bit)) {
        std::string flipped = bytes;
        char& byte = flipped[static_cast<std::size_t>(bit / 8)];
        byte = static_cast<char>(byte ^ (1 << bit % 8));
        write(file, flipped);
        EXPECT_LT(numbersAt(stem).size(), 2u) << bit;
    }
}

// ---- other images ------------------------------------------------------------------------------------

TEST(ReferenceCheckpoint, AnotherImageHasAnotherFile) {
    const Path stem = twoRecords();
    EXPECT_TRUE(numbersAt(stem, other_key).empty());
    EXPECT_EQ(namesIn(stem.parent_path()), (Names{keptName, other_name}));
    EXPECT_EQ(numbersAt(stem), (Numbers{10, 11})) << "nothing is lost";
}

// Images whose keys differ only in the half that the name lacks, or whose records have another size.
TEST(ReferenceCheckpoint, WhatHasItsNameByChanceIsLeftAlone) {
    const Path stem = twoRecords();
    EXPECT_TRUE(numbersAt(stem, key ^ 1).empty());
    EXPECT_TRUE(numbersAt(stem, key, 2).empty());
    EXPECT_EQ(numbersAt(stem), (Numbers{10, 11}));
    EXPECT_EQ(namesIn(stem.parent_path()),
              (Names{keptName, std::string(keptName) + "-2", std::string(keptName) + "-3"}));
    const std::string text(5000, 'x');
    write(stem.parent_path() / other_name, text);
    {
        Checkpoint checkpoint(stem, other_key, 3);
        EXPECT_TRUE(checkpoint.takeEarlier().empty());
        EXPECT_EQ(checkpoint.file().filename(), std::string(other_name) + "-2");
        checkpoint.keep(10, firstValues);
    }
    EXPECT_EQ(numbersAt(stem, other_key), (Numbers{10}));
    EXPECT_EQ(contentsOf(stem.parent_path() / other_name), text);
}

// Its records would be taken for ours.
TEST(ReferenceCheckpoint, AFileThatOthersMayWriteIsLeftAlone) {
    const Path stem = twoRecords(), file = stem.parent_path() / keptName;
    ASSERT_EQ(::chmod(file.c_str(), 0666), 0);
    EXPECT_TRUE(numbersAt(stem).empty());
    EXPECT_EQ(namesIn(stem.parent_path()), (Names{keptName, std::string(keptName) + "-2"}));
    ASSERT_EQ(::chmod(file.c_str(), 0644), 0);
    EXPECT_EQ(numbersAt(stem), (Numbers{10, 11})) << "ours alone";
}

TEST(ReferenceCheckpoint, WhatOthersLeftIsNamed) {
    const Path stem = twoRecords(), file = stem.parent_path() / keptName;
    write(stem.parent_path() / "kept-1", "as they were called once");
    write(stem.parent_path() / "kept-notes.txt", "not ours");
    write(stem.parent_path() / "kept-", "not ours");
    write(stem.parent_path() / "kept", "not ours");
    std::filesystem::create_directory(stem.parent_path() / "kept-2");
    const std::vector<Path> all{file, stem.parent_path() / "kept-1"};
    EXPECT_EQ(abandonedCheckpoints(stem), all);
    {
        const Checkpoint checkpoint(stem, key, 3);
        EXPECT_EQ(abandonedCheckpoints(stem), std::vector<Path>{all[1]}) << "one that is written to";
    }
    EXPECT_EQ(abandonedCheckpoints(stem), all);
    EXPECT_TRUE(abandonedCheckpoints(folder() / "absent" / "kept").empty());
}

// ---- one image, two programs -------------------------------------------------------------------------

TEST(ReferenceCheckpoint, TwoAtOnceHaveAFileEach) {
    const Path stem = twoRecords();
    {
        Checkpoint one(stem, key, 3);
        Checkpoint two(stem, key, 3);
        EXPECT_EQ(two.file().filename(), std::string(keptName) + "-2");
        EXPECT_EQ(numbersIn(one), (Numbers{10, 11}));
        EXPECT_EQ(numbersIn(two), (Numbers{10, 11})) << "what the other has done is not done twice";
        one.keep(12, secondValues);
        two.keep(13, secondValues);
        two.keep(12, secondValues);
    }
    // Both programs have ended without finishing.
    EXPECT_EQ(numbersAt(stem), (Numbers{10, 11, 12, 13}));
    EXPECT_EQ(namesIn(stem.parent_path()), Names{keptName}) << "one file holds it all";
    EXPECT_EQ(numbersAt(stem), (Numbers{10, 11, 12, 13}));
}

// The second of two programs was killed before it wrote anything.
TEST(ReferenceCheckpoint, WhatWasJustBegunIsRemoved) {
    const Path stem = twoRecords(), second = stem.parent_path() / (std::string(keptName) + "-2");
    for (const std::size_t size : {0, 10}) {
        write(second, contentsOf(stem.parent_path() / keptName).substr(0, size));
        EXPECT_EQ(numbersAt(stem), (Numbers{10, 11}));
        EXPECT_EQ(namesIn(stem.parent_path()), Names{keptName}) << size;
    }
}

TEST(ReferenceCheckpoint, TheFirstToFinishTakesNothingFromTheOther) {
    const Path stem = twoRecords();
    {
        Checkpoint one(stem, key, 3), two(stem, key, 3);
        two.keep(12, secondValues);
        one.remove();
        one.keep(13, secondValues);  // after remove() nothing is stored
        EXPECT_EQ(namesIn(stem.parent_path()), Names{std::string(keptName) + "-2"});
    }
    EXPECT_EQ(numbersAt(stem), (Numbers{10, 11, 12})) << "with what it had from the first";
    EXPECT_EQ(namesIn(stem.parent_path()), Names{keptName});
    Checkpoint(stem, key, 3).remove();
    EXPECT_TRUE(namesIn(stem.parent_path()).empty());
}

// ---- faults ------------------------------------------------------------------------------------------

TEST(ReferenceCheckpoint, ALinkIsNotFollowed) {
    const Path stem = folder() / "kept", elsewhere = stem.parent_path() / "elsewhere";
    for (const bool there : {false, true}) {
        if (there) write(elsewhere, "theirs");
        std::filesystem::remove(stem.parent_path() / keptName);
        std::filesystem::create_symlink(elsewhere, stem.parent_path() / keptName);
        EXPECT_THROW(Checkpoint(stem, key, 3), std::runtime_error);
        EXPECT_EQ(contentsOf(elsewhere), there ? "theirs" : "");
        EXPECT_EQ(std::filesystem::exists(elsewhere), there);
    }
}

TEST(ReferenceCheckpoint, WhatCannotBeWrittenIsNamed) {
    const Path stem = folder() / "absent" / "kept";
    const std::string refusal = faultOf([&] { Checkpoint checkpoint(stem, key, 3); });
    EXPECT_NE(refusal.find((stem.parent_path() / keptName).string()), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos);
}

// A full disk, simulated by a limit that only fits the header.
TEST(ReferenceCheckpoint, WhatFindsNoRoomIsAnError) {
    const Path stem = folder() / "kept";
    struct rlimit before {};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    struct rlimit small = before;
    small.rlim_cur = 40;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    bool thrown = false;
    {
        Checkpoint checkpoint(stem, key, 3);
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
        try {
            checkpoint.keep(10, firstValues);
        } catch (const std::runtime_error&) {
            thrown = true;
        }
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_TRUE(thrown);
    EXPECT_TRUE(numbersAt(stem).empty());
}

}  // namespace
}  // namespace diptych::reference
