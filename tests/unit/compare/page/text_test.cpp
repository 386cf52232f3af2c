// SPDX-License-Identifier: MIT
// Numbers and names in pages and tables.
#include "compare/page/text.h"

#include "shared/contract/debug_mode.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace diptych::page {
namespace {

TEST(PageText, BytesAreCountedInPowersOf1024) {
    EXPECT_EQ(bytes(0), "0 B");
    EXPECT_EQ(bytes(1000), "1000 B");
    EXPECT_EQ(bytes(1023), "1023 B");
    EXPECT_EQ(bytes(1024), "1 KiB");
    EXPECT_EQ(bytes(1536), "1.5 KiB");
    EXPECT_EQ(bytes(1000 * 1024), "1000 KiB");
    EXPECT_EQ(bytes(1310720), "1.25 MiB");
    EXPECT_EQ(bytes(std::uint64_t{3} << 30), "3 GiB");
    EXPECT_EQ(bytes(std::uint64_t{5} << 40), "5 TiB");
    EXPECT_EQ(bytes(std::uint64_t{1} << 53), "8192 TiB") << "no larger unit";
}

TEST(PageText, NumbersHaveThreeDigits) {
    EXPECT_EQ(number(0), "0");
    EXPECT_EQ(number(0.0123456), "0.0123");
    EXPECT_EQ(number(1234), "1.23e+03");
    EXPECT_EQ(number(1.2e-7), "1.2e-07");
    EXPECT_EQ(number(std::numeric_limits<double>::infinity()), "inf");
}

TEST(PageText, MarkupIsTextForElementsAndAttributes) {
    EXPECT_EQ(markup("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
    EXPECT_EQ(markup("a\tb\nc\rd"), "a\tb\nc\rd") << "XML 1.0 allows these three";
    EXPECT_EQ(markup("\x01\x1f\x7f"), "\ufffd\ufffd\ufffd");
    EXPECT_EQ(markup("\u00e4\u20ac\U0001f600"), "\u00e4\u20ac\U0001f600");
    EXPECT_EQ(markup("\xef\xbf\xbe|\xef\xbf\xbf"), "\ufffd|\ufffd") << "U+FFFE and U+FFFF";
    EXPECT_EQ(markup("\xff|\xc0\xaf|\xe2\x82"), "\ufffd|\ufffd\ufffd|\ufffd\ufffd")
        << "no UTF-8, a byte each";
    EXPECT_EQ(markup("\xed\xa0\x80"), "\ufffd\ufffd\ufffd") << "half a pair of UTF-16";
    EXPECT_EQ(markup("a\u009b1m|\u202eb\u2066c\u200fd"), "a\ufffd1m|\ufffdb\ufffdc\ufffdd")
        << "C1, and what reorders text";
    EXPECT_EQ(markup("\xef\xbf\xbd"), "\ufffd");
}

TEST(PageText, TextFromOutsideKeepsItsDirectionToItself) {
    EXPECT_EQ(isolated("a<\u05d0\u202e"), "<bdi>a&lt;\u05d0\ufffd</bdi>");
}

TEST(PageText, NamesLeaveOutTheFoldersThatAllShare) {
    EXPECT_EQ(commonFolder({"/a/b/c/Box.glb", "/a/b/d/Duck.glb"}), "/a/b/");
    EXPECT_EQ(commonFolder({"/a/b/c/Box.glb", "/a/b/d/Duck.glb", "builtin:gallery"}), "/a/b/");
    EXPECT_EQ(commonFolder({"/a/b/Box.glb", "/a/b/Box.glb"}), "/a/b/") << "one scene under two cameras";
    EXPECT_EQ(commonFolder({"/a/bc/x.glb", "/a/b/x.glb"}), "/a/") << "whole folders";
    EXPECT_EQ(commonFolder({"a/x.glb", "b/x.glb"}), "");
    EXPECT_EQ(commonFolder({"/a/x.glb", "b/x.glb"}), "");
    EXPECT_EQ(commonFolder({"x.glb", "a/x.glb"}), "");
    EXPECT_EQ(commonFolder({"builtin:a/b", "builtin:gallery"}), "");
    EXPECT_EQ(commonFolder({}), "");
    EXPECT_EQ(inFolder("/a/b/c/Box.glb", "/a/b/"), "c/Box.glb");
    EXPECT_EQ(inFolder("builtin:gallery", "/a/b/"), "builtin:gallery");
}

TEST(PageText, NamesBreakAfterUnderscores) {
    EXPECT_EQ(breakable("a_b<c"), "a_<wbr>b&lt;c");
    EXPECT_EQ(percent(0.0231), "2.31 %");
}

TEST(PageText, AnglesAloneHaveAUnit) {
    for (const DebugMode& mode : debugModes())
        EXPECT_STREQ(unitOf(mode), isAngle(mode.error_kind) ? "\u00b0" : "") << mode.name;
}

TEST(PageText, ACameraIsCalledByItsNameThenByItsOption) {
    Frame frame;
    EXPECT_EQ(cameraTitle(frame), "default view");
    frame.settings.camera = "1";
    EXPECT_EQ(cameraTitle(frame), "1");
    frame.camera.name = "door";
    EXPECT_EQ(cameraTitle(frame), "door");
}

}  // namespace
}  // namespace diptych::page
