// SPDX-License-Identifier: MIT
#include "compare/files/data_uri.h"

namespace diptych {
std::string base64(std::string_view bytes) {
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto byte = [&](std::size_t i) {
        return i < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) : 0u;
    };
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const unsigned bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (const int shift : {18, 12, 6, 0}) out += letters[bits >> shift & 63];
    }
    for (std::size_t i = bytes.size(); i % 3 != 0; ++i) out[out.size() - (3 - i % 3)] = '=';
    return out;
}

std::string dataUri(std::string_view png) {
    return "data:image/png;base64," + base64(png);
}

}  // namespace diptych
