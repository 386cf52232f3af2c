// SPDX-License-Identifier: MIT
// What stands before the pixels of an EXR file, read with suspicion. OpenEXR allocates what attributes claim
// and trusts their types to have the sizes they should; it is handed none but those that pictures need, after
// every length has been checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// A pixel window, both ends inside.
struct ExrWindow {
    std::int32_t min_x = 0, min_y = 0, max_x = -1, max_y = -1;
    std::int64_t width() const { return std::int64_t{max_x} - min_x + 1; }
    std::int64_t height() const { return std::int64_t{max_y} - min_y + 1; }
    bool operator==(const ExrWindow&) const = default;
};

// The first part's.
struct ExrHeader {
    ExrWindow data, display;
    std::vector<std::string> channels;  // by their names
    std::uint64_t stored_bytes = 0;     // of all pixels, uncompressed
    // The file's beginning, as long as it was, to be read in its place: headers of the same parts that hold
    // the needed attributes and one that fills the room of the others.
    std::vector<std::byte> bytes;
};

// Throws std::runtime_error without a name where a header is broken, is of deep or subsampled pixels, or
// claims what the file cannot hold; a picture that needs over `most` bytes as float32 is refused.
ExrHeader readExrHeader(std::span<const std::byte> file, std::uint64_t most);

}  // namespace diptych
