// SPDX-License-Identifier: MIT
#include "compare/output/policy.h"
#include "compare/output/writers.h"

#include "compare/page/emitted.h"
#include "compare/page/page.h"
#include "compare/page/text.h"
#include "shared/text/fail.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych::output {

using page::markup;

namespace {

std::string attribute(const char* name, std::string_view value) {
    return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, markup(value));
}

// An id or an address; keeps what stands for a comparison's index.
std::string addressed(std::string_view text) {
    const std::size_t later = text.find(page::indexPlaceholder);
    return later == text.npos ? markup(text)
                              : fmt::format("{}{}{}", markup(text.substr(0, later)), page::indexPlaceholder,
                                            addressed(text.substr(later + 1)));
}

std::string classes(std::initializer_list<std::string_view> all) {
    std::string joined;
    for (const std::string_view one : all)
        if (!one.empty()) joined += fmt::format("{}{}", joined.empty() ? "" : " ", one);
    return attribute("class", joined);
}

std::string markupOf(const Span& span) {
    switch (span.kind) {
        case Span::plain:
            return span.style.empty()
                       ? markup(span.text)
                       : fmt::format("<span class=\"{}\">{}</span>", span.style, markup(span.text));
        case Span::name:
            return page::breakable(span.text);
        case Span::foreign:
            return page::isolated(span.text);
        case Span::strong:
            return fmt::format("<b>{}</b>", markup(span.text));
        case Span::title:
            return fmt::format("<h3>{}</h3>", markup(span.text));
        case Span::link:
            return fmt::format("<a href=\"{}\">{}</a>", addressed(span.style), page::breakable(span.text));
        case Span::verdict:
            return fmt::format("<span class=\"verdict {}\">{}</span>", span.style, markup(span.text));
        case Span::command:
            return fmt::format(
                "<span class=\"again\"><code>{}</code><button type=\"button\" "
                "data-do=\"copy\">copy</button></span>",
                markup(span.text));
        case Span::swatch:
            return fmt::format("<i class=\"swatch {}\"></i>", span.style);
        case Span::drawn:
            return span.text;
    }
    return {};
}

std::string boxed(const std::string& style, const std::string& inner) {
    return style.empty() ? inner : fmt::format("<div class=\"{}\">{}</div>\n", style, inner);
}

std::string_view kindOf(const Column& column) {
    return column.kind == Column::number ? "n" : column.kind == Column::prose ? "whole" : "";
}

// Nothing if no column has a title.
std::string headOf(const Table& table) {
    std::string out;
    for (const auto& [title, count] : table.groups)
        out += fmt::format("<th class=\"n\" colspan=\"{}\">{}</th>", count, markup(title));
    if (!out.empty()) out += "</tr><tr>";
    for (const Column& column : table.columns)
        out += fmt::format("<th{}{}>{}{}{}</th>", classes({kindOf(column), column.style}),
                           attribute("title", column.means), table.sortable ? "<button type=\"button\">" : "",
                           markup(column.title), table.sortable ? "</button>" : "");
    const bool titled =
        std::ranges::any_of(table.columns, [](const Column& column) { return !column.title.empty(); });
    return titled ? "<thead><tr>" + out + "</tr></thead>\n" : "";
}

std::string rowOf(const Table& table, const Row& row) {
    std::string out = fmt::format("<tr{}{}", classes({row.style}),
                                  row.number > 0 ? fmt::format(" data-row=\"{}\"", row.number) : "");
    for (const auto& [name, value] : row.data) out += fmt::format(" data-{}=\"{}\"", name, markup(value));
    out += '>';
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const Column& column = table.columns[i];
        const Cell& cell = row.cells.at(i);
        out += fmt::format(
            "<td{}{}{}>{}</td>", classes({kindOf(column), column.style, cell.style}),
            attribute("title", cell.means),
            cell.value ? fmt::format(" data-value=\"{}\"", std::isfinite(*cell.value) ? *cell.value : 1e300)
                       : "",
            inHtml(cell.page.value_or(cell.text)));
    }
    return out + "</tr>\n";
}

// What surrounds the title and the body of every page.
std::string allScripts(std::string_view script) {
    return fmt::format("{}{}", page::tables, script);
}
std::string beforeTitle(std::string_view script) {
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">{}<meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\"><title>Diptych: ",
        pagePolicy(allScripts(script)));
}
std::string afterTitle(std::string_view style) {
    return fmt::format("</title>\n<style>{}{}</style></head>\n<body>\n", page::style, style);
}
std::string afterBody(std::string_view script) {
    return fmt::format("<script>{}</script>\n</body></html>\n", allScripts(script));
}

// The markup of each kind of block.
struct Markup {
    std::string operator()(const Heading& h) const {
        return fmt::format("<h{0}{1}>{2}</h{0}>\n", h.level, classes({h.style}), inHtml(h.text));
    }
    std::string operator()(const Paragraph& p) const {
        return fmt::format("<p{}>{}</p>\n", classes({p.style}), inHtml(p.text));
    }
    std::string operator()(const List& list) const {
        std::string out;
        for (const Text& item : list.items) out += "<li>" + inHtml(item) + "</li>";
        return out.empty() ? out : boxed(list.box, "<ul>" + out + "</ul>");
    }
    std::string operator()(const Terms& terms) const {
        std::string out;
        for (const auto& [term, meaning] : terms.items)
            out += fmt::format("<dt>{}</dt><dd>{}</dd>", inHtml(term), inHtml(meaning));
        return out.empty() ? out : boxed(terms.box, "<dl>" + out + "</dl>");
    }
    std::string operator()(const Table& table) const {
        std::string out = fmt::format("<table{}>", classes({table.style, table.sortable ? "sortable" : ""})) +
                          headOf(table) + "<tbody>";
        for (const Row& row : table.rows) out += rowOf(table, row);
        out += "</tbody></table>";
        if (!table.note.empty()) out += (*this)(Paragraph{table.note, "soft small"});
        return boxed(table.box, out);
    }
    std::string operator()(const ImageBlock& image) const {
        return fmt::format(
            "<figure><img loading=\"lazy\" src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
            markup(image.source), markup(image.alt), inHtml(image.caption));
    }
    std::string operator()(const Drawing& drawing) const { return drawing.markup; }
    std::string operator()(const Box& box) const {
        const std::string id = box.id.empty() ? "" : fmt::format(" id=\"{}\"", addressed(box.id)),
                          attributes = classes({box.style}) + id, inner = inHtml(box.blocks);
        return box.summary.spans.empty()
                   ? fmt::format("<div{}>{}</div>\n", attributes, inner)
                   : fmt::format("<details{}{}><summary>{}</summary>{}</details>\n", attributes,
                                 box.open ? " open" : "", inHtml(box.summary), inner);
    }
};

}  // namespace

Cell numberCell(double value) {
    return sorted(value, page::number(value));
}

std::string inHtml(const Text& text) {
    std::string out;
    for (const Span& span : text.spans) out += markupOf(span);
    return out;
}

std::string inHtml(const Block& block) {
    return std::visit(Markup(), block.content);
}

std::string inHtml(const std::vector<Block>& blocks) {
    std::string out;
    for (const Block& block : blocks)
        if (block.where != Block::terminal) out += inHtml(block);
    return out;
}

std::string inHtml(const Document& document) {
    std::string files;
    for (const std::string& file : document.files)
        files += fmt::format("<a href=\"{0}\">{0}</a> ", markup(file));
    const auto line = [](const char* start, const Text& text) {
        return text.spans.empty() ? "" : start + inHtml(text) + "</p>";
    };
    return beforeTitle(document.script) + markup(document.title) + afterTitle(document.style) +
           fmt::format(
               "{}<header><p class=\"brand\">Diptych</p><h1>{}</h1>{}{}</header>\n",
               document.skip.empty()
                   ? ""
                   : fmt::format("<a class=\"skip\" href=\"#{}\">Skip to the results</a>", document.skip),
               inHtml(document.heading), line("<p>", document.finding),
               line("<p class=\"soft\">", document.about)) +
           inHtml(document.blocks) + fmt::format("<footer><p>{}</p></footer>", files) +
           afterBody(document.script);
}

void checkPage(std::string_view text, std::string_view style, std::string_view script) {
    const std::string start = beforeTitle(script), head = afterTitle(style), end = afterBody(script);
    const std::size_t title = text.find(head);
    if (!text.starts_with(start) || title == text.npos || !text.ends_with(end) ||
        text.size() < title + head.size() + end.size())
        fail("is not a page of this version of Diptych");
    text.remove_suffix(end.size());
    const std::size_t name = start.size();
    page::checkMarkup(fmt::format("<p>{}</p>", text.substr(name, title - name)));
    page::checkMarkup(text.substr(title + head.size()));
}

}  // namespace diptych::output
