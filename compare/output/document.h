// SPDX-License-Identifier: MIT
// A result as a small tree: described once, and written by one writer an output (writers.h).
#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace diptych::output {

// Text of one kind. A terminal and a CSV file show the text alone.
struct Span {
    enum Kind {
        plain,    // style: CSS classes
        name,     // may break after its underscores
        foreign,  // right-to-left letters do not affect their surroundings
        strong,
        title,    // a heading in a box's summary
        link,     // style: address; breaks like a name
        verdict,  // style: pass or fail
        command,  // of a shell; with a button that copies it
        swatch,   // a path's colour; style: its name. Has no text
        drawn,    // markup, which only a page shows
    };
    template <std::convertible_to<std::string_view> String>
    Span(const String& content, Kind its_kind = plain, std::string_view its_style = {})
        : text(std::string_view(content)), kind(its_kind), style(its_style) {}

    std::string text;
    Kind kind;
    std::string style;
};

struct Text {
    Text() = default;
    template <class One>
    requires std::constructible_from<Span, const One&> Text(const One& span) : spans{Span(span)} {}
    Text(std::initializer_list<Span> all) : spans(all) {}

    std::vector<Span> spans;
};

struct Cell {
    Cell() = default;
    template <std::convertible_to<Text> String>
    Cell(const String& content) : text(content) {}

    Text text;
    std::optional<double> value{};  // a page sorts by it; infinity is last
    std::optional<Text> page{};     // on a page, in place of the text
    std::string style{}, means{};   // CSS classes; tooltip
};
inline Cell sorted(double value, Text text) {
    Cell cell(text);
    cell.value = value;
    return cell;
}
Cell numberCell(double value);  // sorted, three digits
inline Cell either(Text terminal, Text page) {
    Cell cell(terminal);
    cell.page = std::move(page);
    return cell;
}
inline Cell styled(Cell cell, std::string style, std::string means = {}) {
    cell.style = std::move(style);
    cell.means = std::move(means);
    return cell;
}

struct Column {
    // number: right-aligned. prose: wraps on a page, and comes last in a terminal.
    enum Kind { text, number, prose };
    enum Where { everywhere, page };

    std::string title;
    Kind kind = text;
    std::size_t width = 0;  // in a terminal, longer text overflows; 0: that of the widest cell
    Where where = everywhere;
    std::string style{}, means{};  // CSS classes; the title's tooltip
};

struct Row {
    std::vector<Cell> cells;  // one per column
    std::string style{};
    std::size_t number = 0;                                   // data-row; 0: none
    std::vector<std::pair<std::string, std::string>> data{};  // names without "data-", values
};

// Heads above the heads: a title and its number of columns.
using ColumnGroup = std::pair<std::string, std::size_t>;

struct Table {
    std::vector<Column> columns;
    std::vector<Row> rows{};
    bool sortable = false;                // by a click on a head (compare/page/tables.js)
    std::string style = "stack";          // CSS classes of the table
    std::string box = "box scroll rows";  // and of the element around it
    std::vector<ColumnGroup> groups{};    // all columns or none
    std::string note{};                   // below the table, on a page
    std::size_t indent = 0, gap = 2;      // spaces before and between columns, in a terminal
};

// Adds a column with a cell for each item; items are rows.
template <class Items, class CellOf>
void addColumn(Table& table, Column column, const Items& items, const CellOf& cellOf) {
    table.columns.push_back(std::move(column));
    table.rows.resize(items.size());
    std::size_t row = 0;
    for (const auto& item : items) table.rows[row++].cells.push_back(Cell(cellOf(item)));
}

struct Heading {
    int level;
    Text text;
    std::string style{};
};
struct Paragraph {
    Text text;
    std::string style{};
};
// Nothing without items. `box`: classes of the element around it; empty: none.
struct List {
    std::vector<Text> items;
    std::string box{};
};
struct Terms {
    std::vector<std::pair<Text, Text>> items;
    std::string box{};
};
// An image and what it shows.
struct ImageBlock {
    std::string source, alt;
    Text caption;
};
// A plot or a part of a page that has no other form.
struct Drawing {
    std::string markup;
};
struct Block;
struct Box {
    std::string style;
    std::vector<Block> blocks;
    std::string id{};
    Text summary{};     // not empty: the box opens at a click on it
    bool open = false;  // before any click
};

template <class One, class... All>
concept among = (std::same_as<One, All> || ...);

struct Block {
    enum Where { everywhere, page, terminal };

    template <among<Heading, Paragraph, List, Terms, Table, ImageBlock, Drawing, Box> One>
    Block(One of, Where its_where = everywhere) : content(std::move(of)), where(its_where) {}

    std::variant<Heading, Paragraph, List, Terms, Table, ImageBlock, Drawing, Box> content;
    Where where;
};

// A page.
struct Document {
    std::string title;  // of the window, after "Diptych: "
    Text heading;
    Text about;  // a line below, in grey
    std::vector<Block> blocks;
    std::vector<std::string> files{};  // linked at the end
    std::string style{}, script{};     // besides those of compare/page
    std::string skip{};                // a box's id, to which a link at the top leads
    Text finding{};                    // the result, below the heading
};

}  // namespace diptych::output
