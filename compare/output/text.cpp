// SPDX-License-Identifier: MIT
// Tables for a terminal and as CSV.
#include "compare/output/writers.h"

#include "shared/text/one_line.h"

#include <algorithm>

namespace diptych::output {
namespace {

using Line = std::vector<std::string>;

// East Asian letters and emoji, which take two columns of a terminal (Unicode Standard Annex 11).
bool isDouble(char32_t c) {
    constexpr std::pair<char32_t, char32_t> ranges[] = {
        {0x1100, 0x115f},   {0x2e80, 0x303e},   {0x3041, 0xa4cf},  {0xac00, 0xd7a3},
        {0xf900, 0xfaff},   {0xfe30, 0xfe6f},   {0xff00, 0xff60},  {0xffe0, 0xffe6},
        {0x1f300, 0x1f64f}, {0x1f900, 0x1f9ff}, {0x20000, 0x3fffd}};
    return std::ranges::any_of(ranges, [c](const auto& r) { return c >= r.first && c <= r.second; });
}

std::size_t widthOf(std::string_view text) {
    std::size_t width = 0;
    while (!text.empty()) {
        const auto [code, size] = characterAt(text);
        width += isDouble(code) ? 2 : 1;
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return width;
}

std::string plainText(const Text& text) {
    std::string sentence;
    for (const Span& span : text.spans)
        if (span.kind != Span::drawn) sentence += span.text;
    return sentence;
}

// For a terminal. A name with line breaks begins no line of its own; other controls are printOut()'s task.
std::string lineOf(std::string sentence) {
    for (std::size_t at; (at = sentence.find('\n')) != sentence.npos;) sentence.replace(at, 1, "\\u000a");
    return sentence;
}
std::string lineOf(const Text& text) {
    return lineOf(plainText(text));
}

// Heads and rows of some columns.
std::vector<Line> linesOf(const Table& table, const std::vector<std::size_t>& columns) {
    std::vector<Line> lines(table.rows.size() + 1);
    for (const std::size_t i : columns) {
        lines[0].push_back(table.columns[i].title);
        for (std::size_t row = 0; row < table.rows.size(); ++row)
            lines[row + 1].push_back(plainText(table.rows[row].cells.at(i).text));
    }
    return lines;
}

std::string groupLine(const Table& table, const std::vector<std::size_t>& widths) {
    std::string line(table.indent, ' ');
    std::size_t column = 0;
    for (const auto& [title, count] : table.groups) {
        std::size_t room = 0;
        for (std::size_t i = 0; i < count; ++i, ++column)
            room += widths[column] + (column > 0 ? table.gap : 0);
        const std::size_t free = room - std::min(room, widthOf(title));
        line += std::string(free / 2, ' ') + title + std::string(free - free / 2, ' ');
    }
    return line + "\n";
}

// The lines of each kind of block.
struct Lines {
    std::string operator()(const Heading& heading) const { return lineOf(heading.text) + "\n"; }
    std::string operator()(const Paragraph& paragraph) const { return lineOf(paragraph.text) + "\n"; }
    std::string operator()(const List& list) const {
        std::string out;
        for (const Text& item : list.items) out += "  " + lineOf(item) + "\n";
        return out;
    }
    std::string operator()(const Terms& terms) const {
        std::string out;
        for (const auto& [term, meaning] : terms.items) out += lineOf(term) + ": " + lineOf(meaning) + "\n";
        return out;
    }
    std::string operator()(const Table& table) const { return inText(table); }
    std::string operator()(const ImageBlock&) const { return {}; }
    std::string operator()(const Drawing&) const { return {}; }
    std::string operator()(const Box& box) const {
        return box.summary.spans.empty() ? inText(box.blocks) : std::string();
    }
};

}  // namespace

std::string inText(const std::vector<Block>& blocks) {
    std::string out;
    for (const Block& block : blocks)
        if (block.where != Block::page) out += std::visit(Lines(), block.content);
    return out;
}

std::string inText(const Table& table, std::size_t first, std::size_t last) {
    std::vector<std::size_t> columns;
    for (const bool prose : {false, true})
        for (std::size_t i = 0; i < table.columns.size(); ++i)
            if (const Column& column = table.columns[i];
                column.where != Column::page && (column.kind == Column::prose) == prose)
                columns.push_back(i);
    std::vector<Line> lines = linesOf(table, columns);
    for (Line& line : lines)
        std::ranges::transform(line, line.begin(), [](const std::string& s) { return lineOf(s); });
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        widths.push_back(table.columns[columns[i]].width);
        for (std::size_t line = 0; table.columns[columns[i]].width == 0 && line < lines.size(); ++line)
            widths[i] = std::max(widths[i], widthOf(lines[line][i]));
    }
    std::string out = first == 0 && !table.groups.empty() ? groupLine(table, widths) : "";
    for (std::size_t at = first; at < std::min(last, lines.size()); ++at) {
        std::string line(table.indent, ' ');
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const std::string& sentence = lines[at][i];
            const std::string pad(widths[i] - std::min(widths[i], widthOf(sentence)), ' ');
            const bool right = table.columns[columns[i]].kind == Column::number;
            line += std::string(i > 0 ? table.gap : 0, ' ') + (right ? pad + sentence : sentence + pad);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    return out;
}

std::string inCsv(const Table& table) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 0; i < table.columns.size(); ++i) columns.push_back(i);
    std::string out;
    for (const Line& line : linesOf(table, columns)) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (i > 0) out += ',';
            if (line[i].find_first_of(",\"\r\n") == std::string::npos) {
                out += line[i];
                continue;
            }
            out += '"';
            for (const char c : line[i]) out += c == '"' ? "\"\"" : std::string(1, c);
            out += '"';
        }
        out += "\r\n";
    }
    return out;
}

}  // namespace diptych::output
