// SPDX-License-Identifier: MIT
// Names as pages show them.
#include "compare/page/text.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

TEST(PageText, NamesLeaveOutTheFoldersThatAllShare) {
    using page::commonFolder;
    EXPECT_EQ(commonFolder({"/a/b/c/Box.glb", "/a/b/d/Duck.glb"}), "/a/b/");
    EXPECT_EQ(commonFolder({"/a/b/c/Box.glb", "/a/b/d/Duck.glb", "builtin:gallery"}), "/a/b/");
    EXPECT_EQ(commonFolder({"/a/b/Box.glb", "/a/b/Box.glb"}), "/a/b/") << "one scene under two cameras";
    EXPECT_EQ(commonFolder({"/a/bc/x.glb", "/a/b/x.glb"}), "/a/") << "whole folders";
    EXPECT_EQ(commonFolder({"a/x.glb", "b/x.glb"}), "");
    EXPECT_EQ(commonFolder({"/a/x.glb", "b/x.glb"}), "");
    EXPECT_EQ(commonFolder({"x.glb", "a/x.glb"}), "");
    EXPECT_EQ(commonFolder({"builtin:a/b", "builtin:gallery"}), "");
    EXPECT_EQ(commonFolder({}), "");
    EXPECT_EQ(page::inFolder("/a/b/c/Box.glb", "/a/b/"), "c/Box.glb");
    EXPECT_EQ(page::inFolder("builtin:gallery", "/a/b/"), "builtin:gallery");
}

TEST(PageText, NamesBreakAfterUnderscores) {
    EXPECT_EQ(page::breakable("a_b<c"), "a_<wbr>b&lt;c");
    EXPECT_EQ(page::percent(0.0231), "2.31 %");
}

}  // namespace
}  // namespace diptych
