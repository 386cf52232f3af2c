// SPDX-License-Identifier: MIT
// WebP files written by libwebp, and its container written by hand. Pixels are RGBA, row 0 on top.
#pragma once

#include <webp/encode.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

struct WebpPixels {
    int width = 1, height = 1;
    std::vector<std::uint8_t> rgba;
};

// Colours of every kind, alpha from 1 to 255 or opaque.
inline WebpPixels colourfulWebp(int width, int height, bool opaque) {
    WebpPixels made{width, height, {}};
    std::uint32_t state = 1;
    const auto next = [&] { return (state = state * 1664525u + 1013904223u) >> 24; };
    for (int i = 0; i < width * height; ++i) {
        for (int c = 0; c < 3; ++c) made.rgba.push_back(static_cast<std::uint8_t>(next()));
        made.rgba.push_back(opaque ? std::uint8_t{255} : static_cast<std::uint8_t>(next() | 1));
    }
    return made;
}

inline WebpPixels plainWebp(int width, int height, const std::vector<std::uint8_t>& rgba) {
    WebpPixels made{width, height, {}};
    for (int i = 0; i < width * height; ++i) made.rgba.insert(made.rgba.end(), rgba.begin(), rgba.end());
    return made;
}

inline std::string webpOf(std::uint8_t* encoded, std::size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(encoded), size);
    WebPFree(encoded);
    return bytes;
}

inline std::string losslessWebp(const WebpPixels& of) {
    std::uint8_t* bytes = nullptr;
    const std::size_t size =
        WebPEncodeLosslessRGBA(of.rgba.data(), of.width, of.height, 4 * of.width, &bytes);
    return webpOf(bytes, size);
}

// With an alpha chunk if a pixel is not opaque.
inline std::string lossyWebp(const WebpPixels& of, float quality = 75) {
    std::uint8_t* bytes = nullptr;
    const std::size_t size =
        WebPEncodeRGBA(of.rgba.data(), of.width, of.height, 4 * of.width, quality, &bytes);
    return webpOf(bytes, size);
}

// `count` bytes, the least significant first.
inline std::string webpNumber(std::size_t value, int count) {
    std::string bytes;
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i));
    return bytes;
}

inline std::string webpChunk(std::string_view name, std::string_view data) {
    return std::string(name) + webpNumber(data.size(), 4) + std::string(data) +
           std::string(data.size() % 2, '\0');
}

inline std::string webpFile(std::string_view chunks) {
    return webpChunk("RIFF", "WEBP" + std::string(chunks));
}

// Flags of the extended header: 32 a colour profile, 16 alpha, 2 animation.
inline std::string webpHeader(int flags, int width, int height) {
    return webpChunk("VP8X", webpNumber(static_cast<std::size_t>(flags), 4) +
                                 webpNumber(static_cast<std::size_t>(width) - 1, 3) +
                                 webpNumber(static_cast<std::size_t>(height) - 1, 3));
}

// One frame of an animation, from a simple lossless file.
inline std::string animatedWebp(const WebpPixels& of) {
    const std::string frame = losslessWebp(of).substr(12);
    const std::string location = webpNumber(0, 6) + webpNumber(static_cast<std::size_t>(of.width) - 1, 3) +
                                 webpNumber(static_cast<std::size_t>(of.height) - 1, 3) + webpNumber(100, 4);
    return webpFile(webpHeader(2, of.width, of.height) + webpChunk("ANIM", webpNumber(0, 6)) +
                    webpChunk("ANMF", location + frame));
}

}  // namespace diptych
