// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/image.h"
#include "shared/image/png.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace diptych {

// Row-wise float32 access to an image that is stored as float32, or as 8 bits per component (value / 255)
// for a quarter of the memory. The image must outlive it.
class ImageRows {
public:
    ImageRows(const Image& image)
        : width(image.width), height(image.height), components(image.components), image_(&image) {}
    // `shown`: 3 to replicate a grey component.
    explicit ImageRows(const Image8& coded, int shown)
        : width(coded.width), height(coded.height), components(shown), coded_(&coded) {}

    int width, height, components;
    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

    // Copies `count` pixels of row y from column x on.
    void copy(float* to, int x, int y, int count) const {
        const std::size_t n = stored(count);
        if (image_) {
            std::memcpy(to, floats(x, y), n * sizeof(float));
            return;
        }
        const std::uint8_t* from = codes(x, y);
        if (coded_->components == components)
            for (std::size_t i = 0; i < n; ++i) to[i] = values()[from[i]];
        else
            for (std::size_t i = 0; i < n; ++i) to[3 * i] = to[3 * i + 1] = to[3 * i + 2] = values()[from[i]];
    }
    // Row y: in place, or decoded into `buffer`.
    const float* row(int y, std::vector<float>& buffer) const {
        if (image_) return floats(0, y);
        buffer.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(components));
        copy(buffer.data(), 0, y, width);
        return buffer.data();
    }
    // Whether both store the same `count` pixels at (x, y); false if one stores 8 bits and the other
    // floats.
    bool storesSame(const ImageRows& other, int x, int y, int count) const {
        if (image_ && other.image_)
            return std::memcmp(floats(x, y), other.floats(x, y), stored(count) * sizeof(float)) == 0;
        return coded_ && other.coded_ && coded_->components == other.coded_->components &&
               std::memcmp(codes(x, y), other.codes(x, y), stored(count)) == 0;
    }

private:
    static const std::array<float, 256>& values() {
        static const std::array<float, 256> all = [] {
            std::array<float, 256> decoded{};
            for (std::size_t i = 0; i < decoded.size(); ++i) decoded[i] = static_cast<float>(i) / 255.0f;
            return decoded;
        }();
        return all;
    }
    std::size_t stored(int pixels) const {
        return static_cast<std::size_t>(pixels) *
               static_cast<std::size_t>(image_ ? image_->components : coded_->components);
    }
    const float* floats(int x, int y) const { return image_->data.data() + image_->offset(x, y); }
    const std::uint8_t* codes(int x, int y) const {
        return coded_->data.data() + (stored(width) * static_cast<std::size_t>(y) + stored(x));
    }

    const Image* image_ = nullptr;
    const Image8* coded_ = nullptr;
};

// Calls use(i, pixel of a, pixel of b) for rows [from, to) of two images of one size. i is the pixel's
// index in the image.
template <class Use>
void eachPair(const ImageRows& a, const ImageRows& b, int from, int to, const Use& use) {
    std::vector<float> buffers[2];
    for (int y = from; y < to; ++y) {
        const float *p = a.row(y, buffers[0]), *q = b.row(y, buffers[1]);
        std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width);
        for (int x = 0; x < a.width; ++x, ++i, p += a.components, q += b.components) use(i, p, q);
    }
}

// An image in either storage format.
struct StoredImage {
    Image image;
    Image8 coded{};  // used if `image` is empty: 8 bits per component, value / 255
    int shown = 0;   // components of `coded` to compare: 3 for grey, which stores one

    ImageRows rows() const { return image.empty() ? ImageRows(coded, shown) : ImageRows(image); }
    int components() const { return image.empty() ? shown : image.components; }
    // Moves the pixels out, as floats.
    Image takeImage() {
        if (!image.empty()) return std::move(image);
        const ImageRows from(coded, shown);
        Image decoded(from.width, from.height, shown);
        for (int y = 0; y < from.height; ++y) from.copy(&decoded.at(0, y), 0, y, from.width);
        coded = {};
        return decoded;
    }
};

}  // namespace diptych
