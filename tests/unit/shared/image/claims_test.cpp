// SPDX-License-Identifier: MIT
#include "shared/image/claims.h"
#include "shared/image/image_file.h"
#include "tests/support/errors.h"
#include "tests/support/exr_builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <span>

namespace diptych {
namespace {

constexpr std::uint64_t oneGib = std::uint64_t{1} << 30;

TEST(Claims, BytesOfFilesBack64TimesAsMany) {
    EXPECT_EQ(claimMemory(64 * oneGib, oneGib, "a"), nullptr);
    EXPECT_EQ(claimMemory(0, 0, "a"), nullptr);
    const Claim all = claimMemory(66 * oneGib, oneGib, "a");
    EXPECT_NE(all, nullptr);
}

TEST(Claims, ShareOneBudgetAsLongAsTheyAreHeld) {
    Claim first = claimMemory(oneGib, 0, "first");
    const Claim copy = first;
    const auto second = [&] { claimMemory(oneGib + 1, 0, "second"); };
    const std::string said =
        "second: takes 1024 MiB, claimed by 0 bytes, beside 1024 MiB claimed before; the "
        "limit of such claims is 2048 MiB";
    EXPECT_EQ(faultOf(second), said);
    first = {};
    EXPECT_EQ(faultOf(second), said) << "a copy is left";
    {
        const Claim last = claimMemory(oneGib, 0, "last");
        EXPECT_NE(faultOf([] { claimMemory(1, 0, "none"); }), "");
    }
    EXPECT_EQ(faultOf([] { claimMemory(oneGib, 0, "again"); }), "");
    EXPECT_NE(faultOf([] { claimMemory(~std::uint64_t{0}, 0, "beyond"); }), "");
}

// Nothing is allocated for the display window.
TEST(Claims, AnImageIsRefusedByName) {
    MadePart part{"a", {{"R", Imf::FLOAT}, {"G", Imf::FLOAT}, {"B", Imf::FLOAT}, {"A", Imf::FLOAT}}};
    part.data = box(0, 0, 1, 1);
    part.display = box(0, 0, 1023, 1023);
    const std::string exr = exrOf({part});
    const auto read = [&] { return readImage(std::as_bytes(std::span(exr)), "a.exr"); };
    Claim before = claimMemory(2 * oneGib, 0, "before");
    EXPECT_EQ(faultOf(read),
              fmt::format("a.exr: an image of 1024 x 1024 pixels: takes 16 MiB, claimed by {} "
                          "bytes, beside 2048 MiB claimed before; the limit of such claims is 2048 MiB",
                          exr.size()));
    before = {};
    const ImageFile image = read();
    EXPECT_NE(image.claim, nullptr);
    EXPECT_NE(faultOf([] { claimMemory(2 * oneGib - (oneGib >> 7), 0, "beside"); }), "")
        << "as long as it lives";
}

}  // namespace
}  // namespace diptych
