// SPDX-License-Identifier: MIT
// Output of render: one file, or a folder with a list of its files.
#include "compare/report/frame_files.h"
#include "compare/files/diptych_files.h"
#include "compare/files/output.h"
#include "shared/image/exr.h"
#include "shared/image/png.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

namespace fs = std::filesystem;

TEST(FrameFiles, OneFrameAsFileOrFolder) {
    const fs::path here = folder();
    const Frame frame = bothFrames()[1];
    const ChannelSelection lit{&debugMode(Channel::lit)};
    writeFrame(frame, {}, {OutputKind::exr, here / "a.exr"}, lit, {});
    EXPECT_EQ(readExr(here / "a.exr").layers[0].image.at(1, 2, 0), 0.5f);
    writeFrame(frame, {}, {OutputKind::png, here / "a.png"}, lit, {});
    EXPECT_EQ(readPng(here / "a.png").width, 4);
    fs::create_directory(here / "a");
    const std::vector<std::string> files = writeFrameFolder(frame, {}, here / "a", lit, {});
    EXPECT_EQ(namesIn(here / "a"), (std::vector<std::string>{"forward_plus.exr", "frame.json", "lit.png"}));
    EXPECT_EQ(manifestFiles(here / "a", "frame.json"), files) << "frame.json lists what is there, itself too";
    // Files that diptych wrote may be replaced without --force.
    for (const auto& [kind, name] :
         {std::pair{OutputKind::exr, "a.exr"}, {OutputKind::png, "a.png"}, {OutputKind::folder, "a"}})
        EXPECT_NO_THROW(checkReplaceable({kind, here / name}, "frame.json", false)) << name;
    EXPECT_THROW(writeFrame(bothFrames()[0], {}, {OutputKind::png, here / "t.png"},
                            {&debugMode(Channel::texcoords)}, {}),
                 std::runtime_error);
}

TEST(FrameFiles, AnImageOfEachChannelAskedFor) {
    const fs::path here = folder();
    const Frame frame = bothFrames()[1];
    const ChannelSelection two{&debugMode(Channel::lit), &debugMode(Channel::normals)};
    writeFrame(frame, {}, {OutputKind::png, here / "a.png"}, two, {});
    EXPECT_EQ(namesIn(here), (std::vector<std::string>{"a.lit.png", "a.normals.png"}));
    const auto pixels = [](const fs::path& file) { return readPng(file).data; };
    EXPECT_NE(pixels(here / "a.lit.png"), pixels(here / "a.normals.png"));
    fs::create_directory(here / "b");
    const std::vector<std::string> files = writeFrameFolder(frame, {}, here / "b", two, {});
    EXPECT_EQ(namesIn(here / "b"),
              (std::vector<std::string>{"forward_plus.exr", "frame.json", "lit.png", "normals.png"}));
    EXPECT_EQ(manifestFiles(here / "b", "frame.json"), files);
    EXPECT_EQ(pixels(here / "b" / "normals.png"), pixels(here / "a.normals.png"));
}

}  // namespace
}  // namespace diptych
