// SPDX-License-Identifier: MIT
// What stands before the pixels of an EXR file, read with suspicion. OpenEXR allocates what attributes claim
// and trusts their types to have the sizes they should; it is handed none but those that pictures need, after
// every length of every part has been checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {

// A pixel window, both ends inside.
struct ExrWindow {
    std::int32_t min_x = 0, min_y = 0, max_x = -1, max_y = -1;
    std::int64_t width() const { return std::int64_t{max_x} - min_x + 1; }
    std::int64_t height() const { return std::int64_t{max_y} - min_y + 1; }
    bool holds(const ExrWindow& other) const {
        return other.min_x >= min_x && other.min_y >= min_y && other.max_x <= max_x && other.max_y <= max_y;
    }
    bool operator==(const ExrWindow&) const = default;
};

// The numbers that stand in files.
enum class ExrSample { uint, half, float32 };

struct ExrChannel {
    std::string name;
    ExrSample sample;
};

struct ExrPart {
    int number = 0;    // among the file's
    std::string name;  // "" where it is the only one that is asked for
    ExrWindow data;
    std::vector<ExrChannel> channels;  // as they stand in the file
    std::uint64_t stored_bytes = 0;    // of all pixels, uncompressed
};

// Of the parts that are to be read.
struct ExrHeader {
    ExrWindow display;  // theirs all
    std::vector<ExrPart> parts;
    std::map<std::string, std::string> attributes;  // the strings; of several parts' the first one's
    std::vector<std::string> notes;                 // what is left out, a line each
    // The file's beginning, as long as it was, to be read in its place: headers of the same parts that hold
    // the needed attributes and one that fills the room of the others.
    std::vector<std::byte> bytes;
};

// Of every part, or of the one that is `asked` for by its name. Throws std::runtime_error without a name
// where a header is broken, is of deep or subsampled pixels, or claims what the file cannot hold; pictures of
// different display windows are refused, and such as need over `most` bytes as float32, and uint32 beside it,
// in all.
ExrHeader readExrHeader(std::span<const std::byte> file, std::uint64_t most, std::string_view asked = {});

}  // namespace diptych
