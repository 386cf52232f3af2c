// SPDX-License-Identifier: MIT
// Source: PNG (ISO/IEC 15948), 5.3; JPEG (ITU-T T.81), B.1.1.
#include "shared/image/chunks.h"

namespace diptych {
namespace {

std::string_view textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::uint32_t bigEndian(std::string_view data, std::size_t at, std::size_t size) {
    if (at > data.size() || size > data.size() - at) return 0;
    std::uint32_t number = 0;
    for (const char c : data.substr(at, size)) number = number << 8 | static_cast<unsigned char>(c);
    return number;
}

void visitPng(std::span<const std::byte> file, const TakeChunk& take) {
    constexpr std::size_t signature = 8, around = 12;  // length, name and checksum of a chunk
    const std::string_view text = textOf(file);
    for (std::size_t at = signature; text.size() >= around && at <= text.size() - around;) {
        const std::size_t size = bigEndian(text, at);
        if (size > text.size() - at - around || !take({text.substr(at + 4, 4), text.substr(at + 8, size)}))
            return;
        at += around + size;
    }
}

void visitJpeg(std::span<const std::byte> file, const TakeChunk& take) {
    constexpr char scan = '\xda', mark = '\xff';
    const std::string_view text = textOf(file);
    for (std::size_t at = 2; text.size() >= 4 && at <= text.size() - 4;) {
        if (text[at] != mark) return;
        if (text[at + 1] == mark) {  // a fill byte
            ++at;
            continue;
        }
        const std::size_t size = bigEndian(text, at + 2, 2);  // includes its own two bytes
        if (text[at + 1] == scan || size < 2 || size > text.size() - at - 2 ||
            !take({text.substr(at + 1, 1), text.substr(at + 4, size - 2)}))
            return;
        at += 2 + size;
    }
}

}  // namespace diptych
