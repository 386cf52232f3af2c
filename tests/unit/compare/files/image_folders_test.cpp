// SPDX-License-Identifier: MIT
// Names of images that two folders write in different Unicode forms.
#include "compare/files/image_folders.h"
#include "compare/report/image_diff_json.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

TEST(ImageFolders, NamesInAnotherUnicodeFormAreRecognized) {
    using Pair = std::pair<const char*, const char*>;
    for (const auto& [composed, decomposed] :
         {Pair{"caf\u00e9.png", "cafe\u0301.png"}, Pair{"\u1ebf.png", "e\u0302\u0301.png"},
          Pair{"\u304c.exr", "\u304b\u3099.exr"}, Pair{"\uac01.exr", "\u1100\u1161\u11a8.exr"}}) {
        EXPECT_EQ(otherForm(composed, {"a.png", decomposed}), decomposed);
        EXPECT_EQ(otherForm(decomposed, {composed}), composed);
    }
    EXPECT_EQ(otherForm("cafe.png", {"caff.png", "caf\u00e9.png"}), "");
    EXPECT_EQ(otherForm("caf\u00e8.png", {"caf\u00e9.png"}), "") << "another letter in the same form";
}

TEST(ImageFolders, NoCommonNameTellsTheForm) {
    const std::filesystem::path root = folder();
    for (const char* name : {"a/caf\u00e9.png", "b/cafe\u0301.png", "c/tea.png"}) {
        std::filesystem::create_directories((root / name).parent_path());
        std::ofstream(root / name) << "x";
    }
    const std::string said = faultOf([&] { imageFolders(root / "a", root / "b"); });
    EXPECT_NE(said.find("Unicode form"), said.npos) << said;
    const std::string plain = faultOf([&] { imageFolders(root / "a", root / "c"); });
    EXPECT_EQ(plain.find("Unicode form"), plain.npos) << plain;
}

// Images of either folder by their names below it: any letter case of an image's ending, no hidden file or
// folder, nothing else.
TEST(ImageFolders, ImagesArePairedByTheirNames) {
    const std::filesystem::path root = folder();
    for (const char* name :
         {"a/1.exr",    "a/2.PNG",  "a/deep/3.hdr", "a/4.pfm",       "a/5.tif",       "a/6.tiff",
          "a/7.jpg",    "a/8.JPeg", "a/.9.png",     "a/.deep/1.png", "a/notes.txt",   "a/png",
          "a/only.png", "b/1.exr",  "b/2.PNG",      "b/deep/3.hdr",  "b/4.pfm",       "b/5.tif",
          "b/6.tiff",   "b/7.jpg",  "b/8.JPeg",     "b/.9.png",      "b/.deep/1.png", "b/notes.txt",
          "b/png",      "b/2.png",  "b/deep/1.exr", "c/tea.png",     "c/x.jpg"}) {
        std::filesystem::create_directories((root / name).parent_path());
        std::ofstream(root / name) << "x";
    }
    std::filesystem::create_directories(root / "a/folder.png");
    std::filesystem::create_directories(root / "b/folder.png");
    const ImageFolders pairs = imageFolders(root / "a", root / "b");
    EXPECT_EQ(pairs.both, (std::vector<std::string>{"1.exr", "2.PNG", "4.pfm", "5.tif", "6.tiff", "7.jpg",
                                                    "8.JPeg", "deep/3.hdr"}));
    EXPECT_EQ(pairs.reference_alone, std::vector<std::string>{"only.png"});
    EXPECT_EQ(pairs.test_alone, (std::vector<std::string>{"2.png", "deep/1.exr"}));
    EXPECT_EQ(faultOf([&] { imageFolders(root / "a", root / "c"); }),
              (root / "a").string() + " and " + (root / "c").string() +
                  " share no picture name (9 and 2 pictures)");
    EXPECT_EQ(faultOf([&] { imageFolders(root / "absent", root / "c"); }),
              (root / "absent").string() + ": No such file or directory");
}

TEST(ImageFolders, AFailureTellsTheForm) {
    FolderDiff diff{"a", "b", {}, {}, {}, {}};
    diff.reference_alone = {"caf\u00e9.png", "tea.png"};
    diff.test_alone = {"cafe\u0301.png"};
    const std::vector<SceneError> failures = diff.failures();
    ASSERT_EQ(failures.size(), 3u);
    EXPECT_TRUE(failures[0].message.starts_with("is in a only; ")) << failures[0].message;
    EXPECT_EQ(failures[1].message, "is in a only");
    EXPECT_TRUE(failures[2].message.starts_with("is in b only; ")) << failures[2].message;
}

}  // namespace
}  // namespace diptych
