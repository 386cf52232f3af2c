// SPDX-License-Identifier: MIT
#include "compare/reference/checkpoint.h"

#include "tests/unit/files.h"

#include <stdexcept>

namespace diptych::reference {
namespace {

const std::vector<float> first{1, 2, 3}, second{4, 5, 6};

void write(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

// Two records of three floats.
std::filesystem::path twoRecords() {
    const std::filesystem::path file = folder() / "kept";
    Checkpoint checkpoint(file, 7, 3);
    EXPECT_TRUE(checkpoint.takeEarlier().empty());
    checkpoint.keep(10, first);
    checkpoint.keep(11, second);
    return file;
}

std::vector<std::uint64_t> numbersIn(const std::filesystem::path& file, std::uint64_t key = 7,
                                     std::size_t floats = 3) {
    Checkpoint checkpoint(file, key, floats);
    std::vector<std::uint64_t> numbers;
    for (const Checkpoint::Record& record : checkpoint.takeEarlier()) {
        EXPECT_EQ(record.values, record.number == 10 ? first : second);
        numbers.push_back(record.number);
    }
    return numbers;
}

TEST(ReferenceCheckpoint, HoldsWhatIsKept) {
    const std::filesystem::path file = twoRecords();
    EXPECT_EQ(numbersIn(file), (std::vector<std::uint64_t>{10, 11}));
    EXPECT_EQ(numbersIn(file), (std::vector<std::uint64_t>{10, 11})) << "reading changes nothing";
}

TEST(ReferenceCheckpoint, WhereverTheFileEndsWhatIsWholeCounts) {
    const std::filesystem::path file = twoRecords();
    const std::string bytes = contentsOf(file);
    const std::size_t record = 8 + 3 * 4 + 8, head = bytes.size() - 2 * record;
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        write(file, bytes.substr(0, size));
        const std::size_t whole = size < head ? 0 : (size - head) / record;
        EXPECT_EQ(numbersIn(file).size(), whole) << size;
        if (size < head) continue;
        // And goes on behind it.
        write(file, bytes.substr(0, size));
        {
            Checkpoint checkpoint(file, 7, 3);
            if (whole == 0) checkpoint.keep(10, first);
            checkpoint.keep(11, second);
        }
        EXPECT_EQ(numbersIn(file), (std::vector<std::uint64_t>{10, 11})) << size;
    }
}

TEST(ReferenceCheckpoint, EveryBitCounts) {
    const std::filesystem::path file = twoRecords();
    const std::string bytes = contentsOf(file);
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
        std::string flipped = bytes;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
        write(file, flipped);
        EXPECT_LT(numbersIn(file).size(), 2u) << bit;
    }
}

TEST(ReferenceCheckpoint, OfAnotherPictureItIsWrittenAnew) {
    EXPECT_TRUE(numbersIn(twoRecords(), 8).empty());
    EXPECT_TRUE(numbersIn(twoRecords(), 7, 2).empty());
    const std::filesystem::path file = twoRecords();
    numbersIn(file, 8);
    EXPECT_TRUE(numbersIn(file).empty()) << "what it held is gone";
}

TEST(ReferenceCheckpoint, WhatCannotBeWrittenIsNamed) {
    const std::filesystem::path file = folder() / "absent" / "kept";
    try {
        Checkpoint checkpoint(file, 7, 3);
        ADD_FAILURE() << "nothing can be kept there";
    } catch (const std::runtime_error& e) {
        EXPECT_NE(std::string(e.what()).find(file.string()), std::string::npos) << e.what();
        EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
    // A disk that is full.
    if (!std::filesystem::exists("/dev/full")) return;
    EXPECT_THROW(
        {
            Checkpoint full("/dev/full", 7, 3);
            full.keep(1, first);
        },
        std::runtime_error);
}

TEST(ReferenceCheckpoint, WithoutAFileNothingIsKept) {
    Checkpoint checkpoint({}, 7, 3);
    checkpoint.keep(1, first);
    EXPECT_TRUE(checkpoint.takeEarlier().empty());
}

}  // namespace
}  // namespace diptych::reference
