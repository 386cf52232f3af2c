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
