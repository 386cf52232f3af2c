// SPDX-License-Identifier: MIT
// Markup from another machine: all that the writers emit passes, and nothing that leaves its place.
#include "compare/page/emitted.h"
#include "compare/plot/plot.h"
#include "tests/support/errors.h"
#include "tests/support/sources.h"

#include <gtest/gtest.h>

#include <set>

namespace diptych {
namespace {

TEST(Emitted, OnlyWhatTheWritersEmitPasses) {
    using page::checkMarkup;
    for (const char* sound :
         {"", "a &amp; b", "<p class=\"a\">a<wbr>b</p>", "<details open><summary>a</summary></details>",
          "<svg viewBox=\"0 0 1 1\"><title>a</title><rect x=\"1\"/></svg>", "<a href=\"#s\x01\">\x02</a>",
          "<img src=\"_box-1/lit.a..b.png\" data-same>", "<img src=\"data:image/png;base64,AA/+==\">",
          "<i style=\"width:3.5%;background:#aabbcc\"></i>", "<p data-values=\"a/lit.values.js\"></p>"})
        EXPECT_EQ(faultOf([&] { checkMarkup(sound); }), "") << sound;
    for (const char* hostile : {"<meta>",
                                "<style></style>",
                                "<link>",
                                "<script></script>",
                                "<iframe></iframe>",
                                "<base>",
                                "<form></form>",
                                "<P></P>",
                                "<p>",
                                "</p>",
                                "<b><i></b></i>",
                                "<p></p ",
                                "<p></p x>",
                                "<p",
                                "<p class=\"a",
                                "<p class=a></p>",
                                "<p class='a'></p>",
                                "<p class=\"<\"></p>",
                                "<p id=\"a\" id=\"b\"></p>",
                                "<p onclick=\"a\"></p>",
                                "<p/>",
                                "<rect/>",
                                "<title></title>",
                                "<!-- -->",
                                "<![CDATA[]]>",
                                "<?xml?>",
                                "&lt",
                                "&#60;",
                                "a\x04",
                                "\x03",
                                "\xff",
                                "<a href=\"javascript:a\"></a>",
                                "<a href=\" //evil\"></a>",
                                "<a href=\"//evil\"></a>",
                                "<a href=\"/etc\"></a>",
                                "<a href=\"a/../../b\"></a>",
                                "<a href=\"a/%2e%2e/b\"></a>",
                                "<img src=\"data:text/html,a\">",
                                "<i style=\"position:fixed\"></i>",
                                "<i style=\"background:url(a)\"></i>",
                                "<p data-values=\"a.png\"></p>",
                                "<p data-section=\"a.section.js\"></p>"})
        EXPECT_NE(faultOf([&] { checkMarkup(hostile); }), "") << hostile;
}

TEST(Emitted, SuitesOfJunit) {
    using page::checkSuites;
    EXPECT_EQ(faultOf([] {
                  checkSuites(
                      "  <testsuite name=\"a\">\n<testcase name=\"b\"/><system-out>\x03</system-out>"
                      "</testsuite>\n");
              }),
              "");
    for (const char* hostile : {"<testsuite>", "<testcase/>", "<testsuite><p/></testsuite>", "\x01",
                                "</testsuites>", "<testsuite><system-out><![CDATA[</system-out></testsuite>"})
        EXPECT_NE(faultOf([&] { checkSuites(hostile); }), "") << hostile;
}

TEST(Emitted, PlotsInFiles) {
    const std::string plot = svgOf({.title = "a & b"}, PlotTarget::file);
    EXPECT_EQ(faultOf([&] { checkPlot(plot); }), "");
    EXPECT_NE(faultOf([&] { checkPlot(plot + "<style></style>"); }), "");
    EXPECT_NE(faultOf([&] { checkPlot("<svg><script>a</script></svg>"); }), "");
}

// Every element and attribute in the sources of the sections' and the tradeoff pages' writers is known.
TEST(Emitted, WritersAreCovered) {
    static const std::regex element("[^A-Za-z0-9_]<([a-z][a-z0-9]*)[ >/{]"),
        attribute("[ \"]([a-z][a-zA-Z0-9-]*)=\\\\\"");
    const std::set<std::string> outside{"html", "head", "meta", "style", "script", "body", "title", "h"};
    std::size_t elements = 0, attributes = 0;
    for (const auto& [path, text] : sources()) {
        const bool writes = path == "compare/output/html.cpp" || path == "compare/report/card.cpp" ||
                            path == "compare/report/checks.cpp" || path == "compare/report/errors.cpp" ||
                            path == "compare/report/comparison.cpp" || path == "compare/report/frames.cpp" ||
                            path.starts_with("compare/plot/") || path == "compare/explain/html.cpp" ||
                            path == "compare/page/text.cpp" || path == "compare/tradeoff/html.cpp" ||
                            path == "compare/tradeoff/plot.cpp";
        if (!writes || !path.ends_with(".cpp")) continue;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("#include") || line.find('"') == line.npos) continue;
            if (line.find("<meta ") != line.npos || line.find("content=") != line.npos) continue;
            const std::string quoted = line.substr(line.find('"'));
            for (std::sregex_iterator at(quoted.begin(), quoted.end(), element), end; at != end; ++at) {
                const std::string name = (*at)[1];
                if (outside.contains(name)) continue;
                ++elements;
                const std::string open = "<svg><" + name + ">";
                EXPECT_TRUE(faultOf([&] { page::checkMarkup(open + "</" + name + "></svg>"); }).empty() ||
                            faultOf([&] { page::checkMarkup(open + "</svg>"); }).empty())
                    << path << ": " << line;
            }
            for (std::sregex_iterator at(quoted.begin(), quoted.end(), attribute), end; at != end; ++at) {
                const std::string name = (*at)[1];
                ++attributes;
                const std::string value = name == "style"         ? "width:1%"
                                          : name == "data-values" ? "a.values.js"
                                                                  : "a";
                EXPECT_EQ(faultOf([&] { page::checkMarkup("<p " + name + "=\"" + value + "\"></p>"); }), "")
                    << path << ": " << line;
            }
        }
    }
    EXPECT_GT(elements, 100u);
    EXPECT_GT(attributes, 100u);
}

}  // namespace
}  // namespace diptych
