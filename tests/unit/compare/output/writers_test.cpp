// SPDX-License-Identifier: MIT
// Tables and pages as their writers write them.
#include "compare/output/writers.h"
#include "compare/output/policy.h"
#include "compare/page/page.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace diptych::output {
namespace {

Table fruit() {
    return {
        {{"name", Column::text, 6},
         {"why", Column::prose},
         {"g", Column::number, 4},
         {"colour", Column::text, 0, Column::page},
         {"code"}},
        {{{"fig", "ripe", "40", "violet", "a1"}},
         {{Text{Span("", Span::swatch, "deferred"), "a<b"}, either("-", ""),
           sorted(std::numeric_limits<double>::infinity(), "1e300"), styled("green", "dark", "leaf"), "b"},
          "chosen",
          7}}};
}

// Prose is last; a cell that is too long moves only its own line.
TEST(OutputText, ColumnsAreAlignedAndProseIsLast) {
    EXPECT_EQ(inText(fruit()),
              "name       g  code  why\n"
              "fig       40  a1    ripe\n"
              "a<b     1e300  b     -\n");
    Table table = fruit();
    table.indent = 3;
    table.gap = 1;
    EXPECT_EQ(inText(table, 1, 2), "   fig      40 a1   ripe\n") << "widths are those of all lines";
    table.rows.clear();
    EXPECT_EQ(inText(table), "   name      g code why\n");
    EXPECT_EQ(inText(table, 1), "");
}

// Letters count as the terminal's columns, not as bytes: those of the ranges of wide letters and emoji as two
// (Unicode Standard Annex 11).
TEST(OutputText, WideLettersKeepTheColumns) {
    const auto columnsOf = [](const char* letter) {
        return inText(Table{.columns = {{"n"}, {"x"}}, .rows = {{{letter, ""}}}, .gap = 0}).find('x');
    };
    for (const char* ends :
         {"\u1100",     "\u115f",     "\u2e80",     "\u303e",    "\u3041",     "\ua4cf",
          "\uac00",     "\ud7a3",     "\uf900",     "\ufaff",    "\ufe30",     "\ufe6f",
          "\uff00",     "\uff60",     "\uffe0",     "\uffe6",    "\U0001f300", "\U0001f64f",
          "\U0001f900", "\U0001f9ff", "\U00020000", "\U0003fffd"})
        EXPECT_EQ(columnsOf(ends), 2u) << ends;
    for (const char* beyond :
         {"\u10ff",     "\u1160",     "\u2e7f",     "\u303f",    "\u3040",     "\ua4d0",
          "\uabff",     "\ud7a4",     "\uf8ff",     "\ufb00",    "\ufe2f",     "\ufe70",
          "\ufeff",     "\uff61",     "\uffdf",     "\uffe7",    "\U0001f2ff", "\U0001f650",
          "\U0001f8ff", "\U0001fa00", "\U0001ffff", "\U0003fffe"})
        EXPECT_EQ(columnsOf(beyond), 1u) << beyond;
    const Table table{{{"n"}, {"x", Column::number}},
                      {{{"\u6f22\u5b57", "1"}}, {{"\u00e4bcde", "22"}}, {{"\U00020000b", "3"}}}};
    EXPECT_EQ(inText(table), "n       x\n\u6f22\u5b57    1\n\u00e4bcde  22\n\U00020000b     3\n");
}

TEST(OutputText, ANameBeginsNoLineOfItsOwn) {
    EXPECT_EQ(inText(Table{{{"n"}, {"x"}}, {{{"a\npass", "1"}}}}), "n            x\na\\u000apass  1\n");
    EXPECT_EQ(inText(std::vector<Block>{Paragraph{{"a\npass"}}}), "a\\u000apass\n");
}

TEST(OutputText, GroupsStandAboveTheMiddleOfTheirColumns) {
    const Table table{.columns = {{"", Column::text, 3}, {"a", Column::number, 3}, {"b", Column::number, 4}},
                      .rows = {{{"x", "1", "2"}}},
                      .groups = {{"", 1}, {"both", 2}}};
    EXPECT_EQ(inText(table), "      both    \n       a     b\nx      1     2\n");
    EXPECT_EQ(inText(table, 1), "x      1     2\n");
}

TEST(OutputCsv, FieldsAreQuotedWhereTheyMustBe) {
    const Table table{{{"a,b"}, {"c"}},
                      {{{"say \"x\"", "1\n2"}}, {{"", Text{"p", Span("q", Span::strong)}}}}};
    EXPECT_EQ(inCsv(table), "\"a,b\",c\r\n\"say \"\"x\"\"\",\"1\n2\"\r\n,pq\r\n");
}

TEST(OutputHtml, ATableHasItsClassesValuesAndHeads) {
    Table table = fruit();
    table.columns[2].means = "grams";
    table.columns[4].style = "dim";
    table.sortable = true;
    table.groups = {{"a&b", 2}, {"", 3}};
    table.note = "of one tree";
    table.rows[0].data = {{"scene", "<\"x"}, {"k", "2"}};
    EXPECT_EQ(inHtml(table),
              "<div class=\"box scroll rows\"><table class=\"stack sortable\"><thead><tr>"
              "<th class=\"n\" colspan=\"2\">a&amp;b</th><th class=\"n\" colspan=\"3\"></th></tr><tr>"
              "<th><button type=\"button\">name</button></th>"
              "<th class=\"whole\"><button type=\"button\">why</button></th>"
              "<th class=\"n\" title=\"grams\"><button type=\"button\">g</button></th>"
              "<th><button type=\"button\">colour</button></th>"
              "<th class=\"dim\"><button type=\"button\">code</button></th></tr></thead>\n<tbody>"
              "<tr data-scene=\"&lt;&quot;x\" data-k=\"2\"><td>fig</td><td class=\"whole\">ripe</td>"
              "<td class=\"n\">40</td><td>violet</td><td class=\"dim\">a1</td></tr>\n"
              "<tr class=\"chosen\" data-row=\"7\"><td><i class=\"swatch deferred\"></i>a&lt;b</td>"
              "<td class=\"whole\"></td><td class=\"n\" data-value=\"1e+300\">1e300</td>"
              "<td class=\"dark\" title=\"leaf\">green</td><td class=\"dim\">b</td></tr>\n"
              "</tbody></table><p class=\"soft small\">of one tree</p>\n</div>\n");
    EXPECT_EQ(inHtml(Table{.columns = {{""}}, .rows = {{{numberCell(0.25)}}}, .style = "", .box = ""}),
              "<table><tbody><tr><td data-value=\"0.25\">0.25</td></tr>\n</tbody></table>")
        << "without titles there is no head";
}

TEST(OutputHtml, EveryKindOfTextHasItsMarkupAndIsEscaped) {
    const std::pair<Span::Kind, const char*> kinds[] = {
        {Span::plain, "<span class=\"s\">&lt;a_b</span>"},
        {Span::name, "&lt;a_<wbr>b"},
        {Span::foreign, "<bdi>&lt;a_b</bdi>"},
        {Span::strong, "<b>&lt;a_b</b>"},
        {Span::title, "<h3>&lt;a_b</h3>"},
        {Span::link, "<a href=\"s\">&lt;a_<wbr>b</a>"},
        {Span::verdict, "<span class=\"verdict s\">&lt;a_b</span>"},
        {Span::command,
         "<span class=\"again\"><code>&lt;a_b</code><button type=\"button\" data-do=\"copy\">copy</button>"
         "</span>"},
        {Span::swatch, "<i class=\"swatch s\"></i>"},
        {Span::drawn, "<a_b"}};
    for (const auto& [kind, page] : kinds) EXPECT_EQ(inHtml(Text{Span("<a_b", kind, "s")}), page);
    EXPECT_EQ(inHtml(Text{"<", Span("x", Span::link, "#\"")}), "&lt;<a href=\"#&quot;\">x</a>");
}

// In the part of a report, a character stands for the comparison's index.
TEST(OutputHtml, AnIndexThatIsNotYetKnownStaysInIdsAndAddresses) {
    EXPECT_NE(inHtml(Text{Span("lit", Span::link, "#c\x01-<lit")}).find("href=\"#c\x01-&lt;lit\""),
              std::string::npos);
    EXPECT_NE(inHtml(Box{"card", {}, "c\x01-lit", "lit", true})
                  .find("<details class=\"card\" id=\"c\x01-lit\" open><summary>lit</summary>"),
              std::string::npos);
    EXPECT_EQ(inHtml(Text{"a\x01"}), "a\xef\xbf\xbd") << "but not in texts";
}

TEST(OutputHtml, ImagesHaveACaption) {
    EXPECT_EQ(inHtml(ImageBlock{"a\".png", "<", {"seen ", Span("y", Span::title)}}),
              "<figure><img loading=\"lazy\" src=\"a&quot;.png\" alt=\"&lt;\"><figcaption>seen <h3>y</h3>"
              "</figcaption></figure>\n");
}

TEST(OutputHtml, ListsWithoutItemsLeaveNothing) {
    EXPECT_EQ(inHtml(List{{}, "box"}), "");
    EXPECT_EQ(inHtml(Terms{{}, "box"}), "");
    EXPECT_EQ(inHtml(List{{"a<"}, "box"}), "<div class=\"box\"><ul><li>a&lt;</li></ul></div>\n");
    EXPECT_EQ(inHtml(Terms{{{"a", "b"}}}), "<dl><dt>a</dt><dd>b</dd></dl>");
}

TEST(OutputHtml, APageHasItsBlocksInOrder) {
    const Document document{.title = "<t>",
                            .heading = {"h", Span("<f>", Span::foreign)},
                            .about = "a",
                            .blocks = {Heading{2, "one", "big"}, Box{"box", {Paragraph{"two", "soft"}}, "id"},
                                       Box{"", {Drawing{"<svg></svg>"}}, "", "three"}},
                            .files = {"x.json", "y&.csv"},
                            .style = "p{}",
                            .script = "run()",
                            .skip = "id",
                            .finding = "<pass>"};
    const std::string page = inHtml(document), script = std::string(page::tables) + "run()";
    EXPECT_EQ(
        page,
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">" + pagePolicy(script) +
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
            "<title>Diptych: &lt;t&gt;</title>\n<style>" +
            std::string(page::style) +
            "p{}</style></head>\n<body>\n<a class=\"skip\" href=\"#id\">Skip to the results</a>"
            "<header><p class=\"brand\">Diptych</p><h1>h<bdi>&lt;f&gt;</bdi></h1><p>&lt;pass&gt;</p>"
            "<p class=\"soft\">a</p></header>\n<h2 class=\"big\">one</h2>\n"
            "<div class=\"box\" id=\"id\"><p class=\"soft\">two</p>\n</div>\n"
            "<details><summary>three</summary><svg></svg></details>\n"
            "<footer><p><a href=\"x.json\">x.json</a> <a href=\"y&amp;.csv\">y&amp;.csv</a> </p></footer>"
            "<script>" +
            script + "</script>\n</body></html>\n");
    EXPECT_EQ(markupFault(page, {"meta"}), "");
    EXPECT_NO_THROW(checkPage(page, "p{}", "run()"));
    EXPECT_THROW(checkPage(page, "", "run()"), std::runtime_error);
    EXPECT_THROW(checkPage(page, "p{}", ""), std::runtime_error);
}

TEST(PagePolicy, ScriptsAreThoseOfThePage) {
    EXPECT_EQ(
        pagePolicy("abc"),
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src " +
            scriptSource("abc") +
            " 'strict-dynamic'; style-src 'unsafe-inline'; img-src 'self' file: data:; base-uri 'none'; "
            "form-action 'none'\">");
}

TEST(OutputText, ATerminalShowsTheSentencesOfThePage) {
    const std::vector<Block> blocks{Heading{2, "Head"},
                                    Box{"box", {List{{"one", Text{"t", Span("wo", Span::strong)}}}}},
                                    Terms{{{"term", "meaning"}}},
                                    Drawing{"<svg/>"},
                                    Box{"", {Paragraph{"folded"}}, "", "open"},
                                    {Paragraph{"on the page"}, Block::page},
                                    {Paragraph{"in the terminal"}, Block::terminal}};
    EXPECT_EQ(inText(blocks), "Head\n  one\n  two\nterm: meaning\nin the terminal\n");
    EXPECT_EQ(inHtml(blocks).find("in the terminal"), std::string::npos);
    EXPECT_NE(inHtml(blocks).find("on the page"), std::string::npos);
}

}  // namespace
}  // namespace diptych::output
