// SPDX-License-Identifier: MIT
// Opens a page in headless Chromium, which `./diptych test` installs (packages.txt). A plain CMake build
// may lack it: the tests that need it are then skipped with a message.
#pragma once

#include "compare/output/policy.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <string>

namespace diptych {

// Name of the program; empty if it is not installed.
inline std::string browser() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"})
        if (std::system((std::string("command -v ") + name + " >/dev/null 2>&1").c_str()) == 0) return name;
    return {};
}

struct Visit {
    nlohmann::json told;  // argument of the script's tell(); null if it was not called
    std::string console;  // every message of the page
    std::string dom;
};

// Appends a script to the page, and allows it in the page's content security policy.
inline void addScript(std::string& page, const std::string& script) {
    page.insert(page.rfind("</body>"), "<script>" + script + "</script>");
    constexpr std::string_view policy = "script-src ";
    if (const std::size_t at = page.find(policy); at != page.npos)
        page.insert(at + policy.size(), scriptSource(script) + " ");
}

// Opens a copy of `page`, beside it, that ends in `script`, and waits until the script has called
// tell(value). In the script, wait(ms) and until(condition) are promises, and $ and $$ find elements.
// `hash`: appended to the page's address. The page is `width` pixels wide. Chromium's window is at least
// 500, so narrower pages are put in a frame: media queries and viewport units work there as on a phone.
inline Visit visit(const Folder& scratch, const fs::path& page, const std::string& script,
                   const std::string& hash = "", int width = 1200, const std::string& flags = "") {
    static const std::string tools = R"(
const $ = s => document.querySelector(s), $$ = s => [...document.querySelectorAll(s)];
const wait = ms => new Promise(done => setTimeout(done, ms));
const until = async condition => {
  for (let i = 0; i < 200 && !condition(); ++i) await wait(20);
  return condition();
};
const tell = value => { if (parent !== window) return parent.postMessage(value, '*'); show(value); };
const show = value => {
  const out = document.createElement('pre');
  out.id = 'told';
  out.textContent = 'TOLD' + JSON.stringify(value) + 'END';
  document.body.append(out);
};
const key = (name, more = {}) => (document.activeElement || document.body).dispatchEvent(
  new KeyboardEvent('keydown', { key: name, bubbles: true, cancelable: true, ...more }));
// A pointer at a part of an element, 0 to 1 from its left and top.
const at = (element, x, y) => {
  const box = element.getBoundingClientRect();
  return { clientX: box.left + x * box.width, clientY: box.top + y * box.height };
};
const pointer = (type, element, x, y, more = {}) => element.dispatchEvent(new PointerEvent(type,
  { bubbles: true, cancelable: true, pointerId: 1, pointerType: 'mouse', ...at(element, x, y), ...more }));
)";
    std::string text = contentsOf(page);
    const std::string own = "(async () => {" + tools + "try {" + script +
                            "} catch (error) { console.error(error.stack); tell('threw ' + error); } })();";
    addScript(text, own);
    const fs::path copy = page.parent_path() / "visited.html";
    std::ofstream(copy, std::ios::binary) << text;
    const fs::path frame = page.parent_path() / "frame.html";
    if (width < 500)
        std::ofstream(frame) << "<!doctype html><body style=margin:0><script>" << tools
                             << "onmessage = event => show(event.data);</script><iframe style=border:0 width="
                             << width << " height=900 src='visited.html" << hash << "'></iframe></body>";
    const Ran ran =
        runShell(scratch,
                 "timeout 120 " + browser() +
                     " --headless=new --no-sandbox --disable-gpu --hide-scrollbars --no-first-run " +
                     "--user-data-dir='" + (scratch / "profile").string() +
                     "' --window-size=" + std::to_string(width) +
                     ",900 --virtual-time-budget=20000 --enable-logging=stderr --v=0 " + flags +
                     " --dump-dom 'file://" + (width < 500 ? frame.string() : copy.string() + hash) + "'",
                 scratch.path());
    fs::remove(copy);
    fs::remove(frame);
    Visit visit;
    visit.dom = ran.out;
    for (std::size_t from = 0; from < ran.err.size();) {
        const std::size_t end = std::min(ran.err.find('\n', from), ran.err.size());
        const std::string line = ran.err.substr(from, end - from);
        if (line.find("CONSOLE") != std::string::npos) visit.console += line + "\n";
        from = end + 1;
    }
    const std::size_t start = ran.out.rfind("TOLD"), end = ran.out.rfind("END</pre>");
    if (start != std::string::npos && end != std::string::npos) {
        std::string json = ran.out.substr(start + 4, end - start - 4);
        for (const auto& [code, letter] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
            for (std::size_t i = json.find(code); i != std::string::npos; i = json.find(code, i + 1))
                json.replace(i, std::string(code).size(), letter);
        visit.told = nlohmann::json::parse(json, nullptr, false);
    }
    return visit;
}

}  // namespace diptych
