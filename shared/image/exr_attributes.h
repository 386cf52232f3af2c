// SPDX-License-Identifier: MIT
// The attributes of one part of an EXR file: parses untrusted headers, and writes sanitized ones for the
// library. Source: "OpenEXR File Layout" (openexr.com).
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

// The unread bytes. Throws std::runtime_error without the file's name if there are too few.
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
    // Needed to read the pixels; type and size are valid.
    std::map<std::string, Bytes, std::less<>> needed;
    // Meaning of the colours, not passed to the library: chromaticities (8 floats), whiteLuminance.
    std::map<std::string, Bytes, std::less<>> meaning;
    std::map<std::string, std::string_view, std::less<>> strings;  // all other "string" attributes
    // Includes the terminating null character.
    Bytes all;

    // Throws if absent.
    Cursor valueOf(std::string_view name) const;
    // "" if absent.
    std::string_view textOf(std::string_view name) const;
};

// Reads attributes up to the empty name that ends them. The result is empty at the end of a multi-part
// header. Throws std::runtime_error without the file's name.
Attributes readAttributes(Cursor& in, Bytes from, bool several);

// Appends the needed attributes, and a filler for the others, so that the header keeps its length. Other
// attributes (previews, histories, manifests of any claimed size) do not reach the library. Display window
// and pixel aspect ratio are made equal in all parts, because the library rejects other files. This reader
// does not take them from the library.
void append(std::vector<std::byte>& out, const Attributes& part);

}  // namespace diptych::exr
