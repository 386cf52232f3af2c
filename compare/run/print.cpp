// SPDX-License-Identifier: MIT
#include "compare/run/print.h"

#include "shared/text/input_file.h"
#include "shared/text/one_line.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

namespace diptych {

namespace {

std::atomic<int> failed{0};  // errno of the first write on stdout that failed

void noteFailure() {
    int none = 0;
    failed.compare_exchange_strong(none, errno != 0 ? errno : EIO);
}

// Bytes before the last character if that may continue after the text, otherwise all bytes.
std::size_t endOfWhole(std::string_view text) {
    for (std::size_t i = 1; i <= std::min<std::size_t>(text.size(), 3); ++i)
        if (static_cast<unsigned char>(text[text.size() - i]) >= 0xc0) return text.size() - i;
    return text.size();
}

}  // namespace

void printText(std::string_view text, ColorChoice color) {
    const std::string shown = escapeControls(text);
    const std::string out = hasColor(color, stdout) ? colored(shown) : shown;
    if (std::fwrite(out.data(), 1, out.size(), stdout) != out.size()) noteFailure();
}

int flushText() {
    if (std::fflush(stdout) != 0) noteFailure();
    return failed;
}

void printFile(InputFile& file) {
    std::string piece(1 << 16, '\0'), begun;  // begun: the first bytes of a character
    for (std::uint64_t left = file.size(); left > 0; left -= piece.size()) {
        piece.resize(std::min<std::uint64_t>(left, piece.size()));
        file.read(std::as_writable_bytes(std::span(piece)));
        const std::string text = begun + piece;
        const std::size_t end = endOfWhole(text);
        printText(text.substr(0, end));
        begun = text.substr(end);
    }
    printText(begun);
}

void printMessage(std::string_view message) {
    const std::string line = "diptych: " + messageLine(message) + "\n";
    std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace diptych
