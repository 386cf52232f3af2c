// SPDX-License-Identifier: MIT
// The attributes of one part of an EXR file: read with suspicion, and written again as the library may have
// them. Source: "OpenEXR File Layout", the format's own description (openexr.com).
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

// What has not been read yet, from the front. Throws std::runtime_error without a name where that is too
// little.
class Cursor {
public:
    explicit Cursor(Bytes rest) : rest_(rest) {}

    std::size_t left() const { return rest_.size(); }
    Bytes take(std::size_t count);
    std::string name();  // up to its null character
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
    std::map<std::string, Bytes, std::less<>> needed;  // what the pixels need, of the right type and size
    std::map<std::string, std::string_view, std::less<>> strings;  // all others of type "string"
    Bytes all;                                                     // with the null character at the end

    // Throws where it is missing.
    Cursor valueOf(std::string_view name) const;
    // "" where it is missing.
    std::string_view textOf(std::string_view name) const;
};

// Up to the empty name that ends them; none at all at the end of several parts. Throws std::runtime_error
// without a name.
Attributes readAttributes(Cursor& in, Bytes from, bool several);

// As long as they stood in the file: the needed attributes, and one that fills the room of the others.
// Previews, histories, manifests of any claimed size are not handed on. Display window and pixel aspect
// ratio, which this reader does not take from the library, are the same in every part: the library opens no
// other file.
void append(std::vector<std::byte>& out, const Attributes& part);

}  // namespace diptych::exr
