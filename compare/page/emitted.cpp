// SPDX-License-Identifier: MIT
#include "compare/page/emitted.h"

#include "shared/text/fail.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <vector>

namespace diptych::page {
namespace {

// Names are separated by spaces, with one at both ends.
struct Grammar {
    std::string_view elements, empty, drawn;  // empty: without an end tag; drawn: only inside <svg>
    std::string_view attributes, flags;       // flags: attributes without a value
    std::string_view outermost;               // "": any
    char32_t later[2];                        // first and last of the characters to be replaced
};

// No element whose contents browsers do not parse as markup: no script, style or textarea. <title> inside
// <svg> is an ordinary element.
constexpr Grammar pages{
    " a article b bdi button code dd details div dl dt figcaption figure footer h1 h2 h3 h4 header i kbd "
    "li ol p section span summary svg table tbody td th thead tr ul ",
    " img input wbr ",
    " circle g path rect text title ",
    " alt aria-label aria-pressed class colspan cx cy d data-do data-figure data-mode "
    "data-names data-pixel data-row data-show data-shows data-unit data-value data-values height href id "
    "loading max min r role src step style tabindex title transform type value viewBox width x xmlns y ",
    " data-same hidden open ",
    "",
    {1, 2}};

constexpr Grammar suites{
    " error failure properties property skipped system-err system-out testcase testsuite ",
    "",
    "",
    " classname errors failures message name skipped tests time timestamp type value ",
    "",
    " testsuite ",
    {3, 3}};

bool isOneOf(std::string_view name, std::string_view names) {
    return !name.empty() && name.find(' ') == name.npos &&
           names.find(fmt::format(" {} ", name)) != names.npos;
}

bool consistsOf(std::string_view text, std::string_view others) {
    return std::ranges::all_of(text, [&](unsigned char c) {
        return std::isalnum(c) || others.find(static_cast<char>(c)) != others.npos;
    });
}

// An anchor in the page, an embedded image, or a file below the page's folder.
bool isAddress(std::string_view value) {
    constexpr std::string_view image = "data:image/png;base64,";
    if (value.empty() || value.starts_with('#')) return true;
    if (value.starts_with(image)) return consistsOf(value.substr(image.size()), "+/=");
    return consistsOf(value.substr(0, 1), "_-") && value.find_first_of(":\\%") == value.npos &&
           value.find("../") == value.npos;
}

// Lengths and colours.
bool isStyle(std::string_view value) {
    while (!value.empty()) {
        const std::string_view one = value.substr(0, value.find(';'));
        value.remove_prefix(std::min(value.size(), one.size() + 1));
        const std::size_t colon = std::min(one.find(':'), one.size());
        const std::string_view set = one.substr(colon);
        if (!isOneOf(one.substr(0, colon), " width --u --v --w background ") ||
            !consistsOf(set, ":.%#,() -") || set.find("url") != set.npos)
            return false;
    }
    return true;
}

class Checker {
public:
    Checker(const Grammar& grammar, std::string_view text) : grammar_(grammar), rest_(text) {}

    void check() {
        while (!rest_.empty()) {
            checkText(taken(std::min(rest_.find('<'), rest_.size())));
            if (rest_.empty()) break;
            taken(1);
            if (rest_.starts_with('/'))
                close();
            else
                open();
        }
        if (!open_.empty()) fail(fmt::format("<{}> is not closed", open_.back()));
    }

private:
    std::string_view taken(std::size_t count) {
        const std::string_view text = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return text;
    }
    std::string_view name() {
        const auto end =
            std::ranges::find_if_not(rest_, [](unsigned char c) { return std::isalnum(c) || c == '-'; });
        return taken(static_cast<std::size_t>(end - rest_.begin()));
    }
    void expect(std::string_view what) {
        if (!rest_.starts_with(what)) fail(fmt::format("has no {} where one must follow", what));
        taken(what.size());
    }

    // Characters and entities are those of markup().
    void checkText(std::string_view text) const {
        constexpr std::string_view entities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
        while (!text.empty()) {
            const auto [code, size] = characterAt(text);
            const bool later = grammar_.later[0] <= code && code <= grammar_.later[1],
                       control = code < ' ' && code != '\t' && code != '\n' && code != '\r';
            if (size == 0 || (control && !later) || code == 0xfffe || code == 0xffff)
                fail("has a character that is not text");
            if (code == '&' && std::ranges::none_of(entities, [&](std::string_view entity) {
                    return text.starts_with(entity);
                }))
                fail("has an & that begins none of Diptych's entities");
            text.remove_prefix(size);
        }
    }

    void close() {
        taken(1);
        const std::string_view element = name();
        expect(">");
        if (open_.empty() || open_.back() != element)
            fail(fmt::format("</{}> closes {}", element, open_.empty() ? "nothing" : open_.back()));
        open_.pop_back();
    }

    void open() {
        const std::string_view element = name();
        const bool empty = isOneOf(element, grammar_.empty), drawn = isOneOf(element, grammar_.drawn);
        if (!empty && !drawn && !isOneOf(element, grammar_.elements))
            fail(fmt::format("<{}> is not an element that Diptych writes", oneLine(element)));
        if (drawn && std::ranges::count(open_, "svg") == 0)
            fail(fmt::format("<{}> is not in a drawing", element));
        if (open_.empty() && !grammar_.outermost.empty() && !isOneOf(element, grammar_.outermost))
            fail(fmt::format("<{}> is outside all suites", element));
        std::vector<std::string_view> seen;
        while (rest_.starts_with(' ')) {
            taken(1);
            if (rest_.starts_with('>') || rest_.starts_with('/')) break;
            attribute(element, seen);
        }
        const bool ended = rest_.starts_with('/');
        if (ended) taken(1);
        expect(">");
        if (ended && !drawn && &grammar_ == &pages) fail(fmt::format("<{}/> has no end tag", element));
        if (!ended && !empty) open_.push_back(element);
    }

    void attribute(std::string_view element, std::vector<std::string_view>& seen) {
        const std::string_view key = name();
        const auto refuse = [&](const char* why) {
            fail(fmt::format("<{}> has an attribute {} that {}", element, oneLine(key), why));
        };
        if (std::ranges::count(seen, key) > 0) refuse("is given twice");
        seen.push_back(key);
        if (isOneOf(key, grammar_.flags)) return;
        if (!isOneOf(key, grammar_.attributes)) refuse("Diptych does not write");
        expect("=\"");
        const std::size_t end = rest_.find_first_of("\"<");
        if (end == rest_.npos || rest_[end] == '<') refuse("is not closed");
        const std::string_view value = taken(end);
        taken(1);
        checkText(value);
        if (&grammar_ != &pages) return;
        if ((key == "href" || key == "src") && !isAddress(value)) refuse("leads elsewhere");
        if (key == "data-values" && !(isAddress(value) && value.ends_with(".values.js")))
            refuse("names no values");
        if (key == "style" && !isStyle(value)) refuse("Diptych does not write so");
    }

    const Grammar& grammar_;
    std::string_view rest_;
    std::vector<std::string_view> open_;
};

}  // namespace

void checkMarkup(std::string_view html) {
    Checker(pages, html).check();
}

void checkSuites(std::string_view xml) {
    Checker(suites, xml).check();
}

}  // namespace diptych::page
