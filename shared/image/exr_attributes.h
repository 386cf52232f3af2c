// SPDX-License-Identifier: MIT
// The attributes of one part of an EXR file: read without trusting the file, and written again in a form
// that is safe to give to the library. Source: "OpenEXR File Layout", the format's own description
// (openexr.com).
#pragma once

#include <cstddef>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::exr {

using Bytes = std::span<const std::byte>;

// The bytes that are not read yet. Throws std::runtime_error without the file's name if there are too few.
class Cursor {
public:
    explicit Cursor(Bytes rest) : rest_(rest) {}

    std::size_t left() const { return rest_.size(); }
    Bytes take(std::size_t count);
    std::string name();  // without its terminating null character
    template <class T>
    T number() {
        T value;
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }

private:
    Bytes rest_;
};

struct Attributes {
    // Those needed to read the pixels, with the right type and size.
    std::map<std::string, Bytes, std::less<>> needed;
    // What its colours mean, which the library is not told: chromaticities (8 floats), whiteLuminance.
    std::map<std::string, Bytes, std::less<>> meaning;
    std::map<std::string, std::string_view, std::less<>> strings;  // all others of type "string"
    Bytes all;                                                     // with the null character at the end

    // Throws if it is missing.
    Cursor valueOf(std::string_view name) const;
    // "" if it is missing.
    std::string_view textOf(std::string_view name) const;
};

// Reads attributes up to the empty name that ends them; the result is empty at the end of the header of a
// file of several parts. Throws std::runtime_error without the file's name.
Attributes readAttributes(Cursor& in, Bytes from, bool several);

// Appends the needed attributes, and a filler that takes the space of the others, so that the header has the
// same length as in the file. Other attributes (previews, histories, manifests of any claimed size) are not
// passed to the library. Display window and pixel aspect ratio, which this reader does not take from the
// library, are made equal in all parts, because the library refuses other files.
void append(std::vector<std::byte>& out, const Attributes& part);

}  // namespace diptych::exr
