// SPDX-License-Identifier: MIT
// Parses the untrusted header of an EXR file. OpenEXR allocates what attributes claim and assumes that
// their types have the right sizes. So it only receives the attributes needed for pixels, after all
// lengths of all parts have been checked.
#pragma once

#include "shared/image/primaries.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// A pixel window; includes both corners.
struct ExrWindow {
    std::int32_t min_x = 0, min_y = 0, max_x = -1, max_y = -1;
    std::int64_t width() const { return std::int64_t{max_x} - min_x + 1; }
    std::int64_t height() const { return std::int64_t{max_y} - min_y + 1; }
    bool holds(const ExrWindow& other) const {
        return other.min_x >= min_x && other.min_y >= min_y && other.max_x <= max_x && other.max_y <= max_y;
    }
    bool operator==(const ExrWindow&) const = default;
};

// Values as in the file format.
enum class ExrSample { uint, half, float32 };

struct ExrChannel {
    std::string name;
    ExrSample sample;
};

struct ExrPart {
    int index = 0;     // index of the part in the file
    std::string name;  // "" if only one part is read
    ExrWindow data;
    std::vector<ExrChannel> channels;  // in the file's order
    std::uint64_t stored_bytes = 0;    // all pixels, uncompressed
    std::uint64_t chunk_bytes = 0;     // one tile or block of lines, uncompressed
    std::optional<glm::dmat3> to_rec709{};
};

// Covers only the parts that are read.
struct ExrHeader {
    ExrWindow display;  // common to all parts
    std::vector<ExrPart> parts;
    std::map<std::string, std::string> attributes;  // string attributes of the first part
    FileNotes notes;
    // Replaces the beginning of the file at the same length: headers of the same parts with only the
    // needed attributes, and a filler for the others.
    std::vector<std::byte> bytes;
};

// Reads the headers of every part, or of the part named `asked`. Throws std::runtime_error without the
// file's name if a header is broken, has deep or subsampled pixels, or claims more than the file can
// contain; if display windows differ; or if all images together need more than `max` bytes as float32
// (plus uint32, where stored).
ExrHeader readExrHeader(std::span<const std::byte> file, std::uint64_t max, std::string_view asked = {});

}  // namespace diptych
