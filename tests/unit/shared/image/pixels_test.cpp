// SPDX-License-Identifier: MIT
// Images spilled to files: the same values at the same address, and no memory after release.
#include "shared/image/image.h"
#include "tests/support/files.h"
#include "tests/support/test_images.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace diptych {
namespace {

// Fraction of the image's pages that are resident in memory.
double residentFraction(const Image& image) {
    std::ifstream maps("/proc/self/smaps");
    const auto begin = reinterpret_cast<std::uintptr_t>(image.data.data());
    std::string word;
    for (std::uintptr_t from = 0, to = 0; maps >> word;) {
        std::uintptr_t low = 0, high = 0;
        if (std::sscanf(word.c_str(), "%lx-%lx", &low, &high) == 2) from = low, to = high;
        if (word != "Rss:" || begin < from || begin >= to) continue;
        double kilobytes = 0;
        maps >> kilobytes;
        return kilobytes * 1024 / static_cast<double>(image.data.size() * sizeof(float));
    }
    return -1;
}

}  // namespace

TEST(Pixels, KeptInAFileTheyStayWhatAndWhereTheyAre) {
    Image image = noise(400, 300, 1);
    const Image before = image;
    const float* const place = image.data.data();
    keepInFile(image.data);
    EXPECT_EQ(image.data.data(), place);
    EXPECT_EQ(image.data, before.data);
    EXPECT_GT(residentFraction(image), 0.99);
    letGo(image.data);
    EXPECT_LT(residentFraction(image), 0.01);
    EXPECT_EQ(image.data, before.data);
    const Image copy = image, moved = std::move(image);
    EXPECT_EQ(moved.data.data(), place);
    letGo(copy.data);
    EXPECT_EQ(copy.data, before.data) << "a copy is in memory";
}

TEST(Pixels, WhatIsInMemoryIsNotLetGo) {
    for (const int width : {4, 400}) {
        const Image image = noise(width, width, 1), before = image;
        letGo(image.data);
        EXPECT_EQ(image.data, before.data) << width;
    }
}

TEST(Pixels, AFileHasNoNameAndNeedsNoFolderOfTheUsers) {
    const std::filesystem::path place = folder();
    const char* const old = std::getenv("TMPDIR");
    const std::string chosen = old ? old : "";
    for (const std::filesystem::path& temporary : {place, place / "none"}) {
        ::setenv("TMPDIR", temporary.c_str(), 1);
        Image image = noise(400, 300, 2);
        const Image before = image;
        keepInFile(image.data);
        letGo(image.data);
        EXPECT_EQ(image.data, before.data) << temporary;
        EXPECT_EQ(namesIn(place), std::vector<std::string>());
    }
    old ? ::setenv("TMPDIR", chosen.c_str(), 1) : ::unsetenv("TMPDIR");
}

// Freed memory is reused: the next image at this address must not be in a file.
TEST(Pixels, MemoryOfOneThatWasKeptIsNewForTheNext) {
    for (int round = 0; round < 4; ++round) {
        Image image = noise(400, 300, static_cast<unsigned>(round));
        letGo(image.data);
        EXPECT_EQ(image.data, noise(400, 300, static_cast<unsigned>(round)).data);
        keepInFile(image.data);
    }
}

}  // namespace diptych
