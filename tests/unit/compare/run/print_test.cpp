// SPDX-License-Identifier: MIT
// A file is printed unchanged although it is read in pieces.
#include "compare/run/print.h"
#include "shared/text/input_file.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace diptych {
namespace {

// The text on stdout for a file with this content.
std::string printedOf(const std::string& text) {
    const std::filesystem::path file = folder() / "report.json";
    std::ofstream(file, std::ios::binary) << text;
    InputFile opened(file);
    testing::internal::CaptureStdout();
    printFile(opened);
    return testing::internal::GetCapturedStdout();
}

TEST(PrintFile, NoCharacterIsCutBetweenTwoPieces) {
    constexpr std::size_t piece = std::size_t{1} << 16;
    // A line end shortly before the first piece's end, and a three-byte character across it, with one or
    // two bytes before.
    for (const std::size_t before : {piece - 1, piece - 2}) {
        std::string text(before - 10, 'a');
        text += "\nbbbbbbbbb\u20ac\n";
        ASSERT_GT(text.size(), piece);
        EXPECT_TRUE(printedOf(text) == text) << before;
        // A line longer than a piece, without a line end.
        text = std::string(before, 'a') + "\u20ac" + std::string(2 * piece, 'b');
        EXPECT_TRUE(printedOf(text) == text) << before;
    }
    for (const std::size_t size : {std::size_t{0}, piece, 2 * piece})
        EXPECT_TRUE(printedOf(std::string(size, '\n')).size() == size) << size;
}

TEST(PrintMessage, IsALineOfTheTool) {
    testing::internal::CaptureStderr();
    printMessage("a.glb: is empty");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "diptych: a.glb: is empty\n");
}

// Output of a file with one long line begins before the file is read to its end.
TEST(PrintFile, ALongLineIsPrintedAsItIsRead) {
    constexpr std::uintmax_t piece = std::uintmax_t{1} << 16;
    const std::filesystem::path file = folder() / "long.json";
    std::ofstream(file, std::ios::binary) << std::string(3 * piece, 'a');
    InputFile opened(file);
    std::filesystem::resize_file(file, 2 * piece);
    testing::internal::CaptureStdout();
    EXPECT_THROW(printFile(opened), std::runtime_error);
    EXPECT_EQ(testing::internal::GetCapturedStdout().size(), 2 * piece);
}

}  // namespace
}  // namespace diptych
