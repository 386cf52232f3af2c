// SPDX-License-Identifier: MIT
// Memory of image pixels. A program may have many images but need few at a time.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <vector>

namespace diptych {

namespace pixels {

// Images of at least this many bytes get whole pages, which return to the system when the image is
// destroyed. Smaller ones are on the heap.
inline constexpr std::size_t ownPages = std::size_t{1} << 18;

void* takePages(std::size_t bytes);  // throws std::bad_alloc
void givePages(void* memory, std::size_t bytes) noexcept;

template <class T>
struct Allocator {
    using value_type = T;
    using is_always_equal = std::true_type;
    Allocator() = default;
    template <class U>
    Allocator(const Allocator<U>&) {}
    bool operator==(const Allocator&) const = default;

    T* allocate(std::size_t n) {
        if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
        return static_cast<T*>(n * sizeof(T) < ownPages ? ::operator new(n * sizeof(T))
                                                        : takePages(n * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t n) noexcept {
        if (n * sizeof(T) < ownPages)
            ::operator delete(memory);
        else
            givePages(memory, n * sizeof(T));
    }
};

}  // namespace pixels

using PixelData = std::vector<float, pixels::Allocator<float>>;

// Moves the pixels to an unnamed temporary file, whose pages the system loads on access. Their address
// stays the same and they stay readable, but no longer writable. The image stays in memory if it is small
// or no such file can be written. Files are in $TMPDIR, else in /var/tmp or /tmp.
void keepInFile(PixelData& image);

// Releases the pages of an image that is spilled to a file until its next access. Does nothing for other
// images.
void letGo(const PixelData& image);

}  // namespace diptych
