// SPDX-License-Identifier: MIT
// Memory for the pixels of an Image, which a program has many of and needs few of at a time.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <vector>

namespace diptych {

namespace pixels {

// Of a picture of this many bytes or more, memory is whole pages of the system's, which it has back as soon
// as the picture dies: smaller ones are left to the heap.
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

// Moves the pixels to a temporary file without a name, of which the system reads a page whenever one is
// looked at: they stay where they are and can be read as before, but no longer written to. A small picture,
// and one for which there is no room in such a file, stays in memory. Files are in $TMPDIR, else in /var/tmp
// or /tmp.
void keepInFile(PixelData& picture);

// That the picture is not needed for now: of one that is kept in a file, no page stays in the program's
// memory until it is looked at again. Any other is left alone.
void letGo(const PixelData& picture);

}  // namespace diptych
