// SPDX-License-Identifier: MIT
// Layers of other renderers may have any name. Each gets its own file inside the report's folder, and the
// page links to it.
#include "compare/files/diptych_files.h"
#include "compare/report/folders.h"
#include "compare/report/image_diff_report.h"
#include "shared/image/exr.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>

namespace diptych {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> strangeNames{"a/b",   "a_b", "a~2fb",       "a~b",      "a b",      "A/B",
                                            "../up", "/",   ".hidden",     "<i>x</i>", "x\"'&",    "c0?x@1,2",
                                            "50%",   "#",   "gr\xc3\xbcn", "a\\b",     "new\tline"};

TEST(ReportNames, OfAFileAreSafeAndNoTwoBecomeTheSame) {
    EXPECT_EQ(nameOfFile("lit_diffuse"), "lit_diffuse") << "ours stay";
    EXPECT_EQ(nameOfFile("a/b"), "a~2fb");
    EXPECT_EQ(nameOfFile("a~2fb"), "a~7e2fb");
    EXPECT_EQ(nameOfFile(".."), "~2e.");
    EXPECT_EQ(nameOfFile("v1.2-x+y"), "v1.2-x+y");
    std::vector<std::string> names = strangeNames;
    for (const char* end : {"", "1", "2", "/"}) names.push_back(std::string(300, '/') + end);
    names.push_back(std::string(160, 'x'));
    names.push_back(std::string(161, 'x'));
    std::set<std::string> files;
    for (const std::string& name : names) {
        const std::string file = nameOfFile(name);
        EXPECT_TRUE(files.insert(file).second) << name << " and another are " << file;
        EXPECT_EQ(
            file.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.~"),
            std::string::npos)
            << file;
        EXPECT_LE(file.size(), 160u);
        EXPECT_NE(file.substr(0, 1), ".");
        EXPECT_TRUE(isDiptychFileName(file + ".png")) << file << ": a later report may remove it";
    }
}

TEST(ReportNames, LayersOfAnyNameHaveTheirFilesAndPlaces) {
    const fs::path here = folder(), out = here / "report";
    const Image dark(4, 3, 1, 0.25f), bright(4, 3, 1, 0.5f);
    std::vector<ExrLayerView> left, right;
    for (const std::string& name : strangeNames) {
        left.push_back({{name + ".Y"}, &dark});
        right.push_back({{name + ".Y"}, &bright});
    }
    writeExr(here / "a.exr", left);
    writeExr(here / "b.exr", right);
    ImageDiffOptions options;
    options.metric = "max";
    ImageDiff diff = diffImages((here / "a.exr").string(), (here / "b.exr").string(), options);
    ASSERT_EQ(diff.channels.size(), strangeNames.size());
    writeDiffs({&diff, 1}, out, {}, {});

    std::size_t images = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
        EXPECT_FALSE(entry.is_directory()) << entry.path();
        images += entry.path().native().ends_with(".difference.png");
    }
    EXPECT_EQ(images, strangeNames.size()) << "none over another";
    EXPECT_EQ(namesIn(here), (std::vector<std::string>{"a.exr", "b.exr", "report"})) << "and none outside";
    const std::string page = contentsOf(out / "index.html");
    EXPECT_EQ(markupFault(page, {"meta", "img", "input", "br", "wbr"}), "");
    EXPECT_EQ(page.find("<i>x</i>"), std::string::npos);
    const std::regex source("src=\"([^\"]*)\""), link("href=\"#(c0-[^\"@]*)");
    for (std::sregex_iterator i(page.begin(), page.end(), source), none; i != none; ++i)
        EXPECT_TRUE(fs::exists(out / (*i)[1].str())) << (*i)[1];
    std::set<std::string> places;
    for (std::sregex_iterator i(page.begin(), page.end(), link), none; i != none; ++i) {
        places.insert((*i)[1]);
        EXPECT_NE(page.find("id=\"" + (*i)[1].str() + "\""), std::string::npos) << (*i)[1];
    }
    EXPECT_EQ(places.size(), strangeNames.size());
}

}  // namespace
}  // namespace diptych
