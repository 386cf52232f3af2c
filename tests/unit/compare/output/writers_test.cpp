// SPDX-License-Identifier: MIT
// Tables and pages as their writers write them.
#include "compare/output/writers.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>

#include <limits>

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

// Letters count as the terminal's columns, not as bytes.
TEST(OutputText, WideLettersKeepTheColumns) {
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
    table.sortable = true;
    table.note = "of one tree";
    const std::string page = inHtml(table);
    EXPECT_EQ(markupFault(page), "") << page;
    for (const char* part :
         {"<div class=\"box scroll rows\"><table class=\"stack sortable\">",
          "<th class=\"n\" title=\"grams\"><button type=\"button\">g</button></th>", "<tr><td>fig</td>",
          "<tr class=\"chosen\" data-row=\"7\"><td><i class=\"swatch deferred\"></i>a&lt;b</td>",
          "<td class=\"whole\"></td><td class=\"n\" data-value=\"1e+300\">1e300</td>",
          "<td class=\"dark\" title=\"leaf\">green</td><td>b</td></tr>",
          "</table><p class=\"soft small\">of one tree</p>"})
        EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
}

TEST(OutputHtml, EveryKindOfTextIsEscaped) {
    for (const Span::Kind kind :
         {Span::plain, Span::name, Span::foreign, Span::strong, Span::link, Span::verdict, Span::command}) {
        const std::string page = inHtml(Text{Span("<&_\"", kind, "s")});
        EXPECT_EQ(markupFault(page, {"wbr"}), "") << page;
        EXPECT_NE(page.find("&lt;&amp;_"), std::string::npos) << page;
    }
    EXPECT_NE(inHtml(Text{Span("x", Span::link, "#\"")}).find("href=\"#&quot;\""), std::string::npos);
    EXPECT_EQ(inHtml(Text{Span("<b>x</b>", Span::drawn)}), "<b>x</b>");
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

TEST(OutputHtml, RowsHaveDataAndImagesACaption) {
    Table table{.columns = {{"a"}}, .rows = {{{"b"}}}};
    table.rows[0].data = {{"scene", "<\"x"}};
    EXPECT_NE(inHtml(table).find("<tr data-scene=\"&lt;&quot;x\"><td>b</td>"), std::string::npos);
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
                            .blocks = {Heading{2, "one"}, Box{"box", {Paragraph{"two", "soft"}}, "id"},
                                       Box{"", {Drawing{"<svg></svg>"}}, "", "three"}, fruit()},
                            .files = {"x.json"},
                            .skip = "id",
                            .finding = "<pass>"};
    const std::string page = inHtml(document);
    EXPECT_EQ(markupFault(page, {"meta"}), "");
    std::size_t at = 0;
    for (const char* part :
         {"<title>Diptych: &lt;t&gt;</title>", "href=\"#id\"", "<h1>h<bdi>&lt;f&gt;</bdi></h1>",
          "<p>&lt;pass&gt;</p>", "<h2>one</h2>", "<div class=\"box\" id=\"id\"><p class=\"soft\">two</p>",
          "<details><summary>three</summary><svg></svg></details>", "<table",
          "<a href=\"x.json\">x.json</a>"}) {
        EXPECT_NE(page.find(part, at), std::string::npos) << part;
        at = page.find(part, at);
    }
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
