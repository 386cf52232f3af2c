// SPDX-License-Identifier: MIT
// What every target asks of a reader: any bytes either are read, and what comes of them keeps its promises,
// or end in one std::runtime_error of one line. All else is a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string_view>

namespace diptych::fuzz {

// Decoded bytes of an image, so that a run meets no input that is merely large.
inline constexpr std::uint64_t most_bytes = std::uint64_t{16} << 20;

inline void require(bool holds, const char* promise) {
    if (holds) return;
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
}

inline std::span<const std::byte> bytesAt(const std::uint8_t* data, std::size_t size) {
    return std::as_bytes(std::span(data, size));
}
inline std::string_view textAt(const std::uint8_t* data, std::size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

// Behind some readers are libraries that are not instrumented: libFuzzer sees no branch of theirs, and would
// keep one input of a thousand kinds. What is observed of an input (a kind, an error's words) counts as a
// branch.
#ifdef DIPTYCH_FUZZ
__attribute__((section("__libfuzzer_extra_counters"))) static std::uint8_t observed[1024];
inline void observe(std::size_t what) {
    observed[what % sizeof observed] = 1;
}
#else
inline void observe(std::size_t) {}
#endif

// The last part of a message without its numbers: names and sizes of the file would be a branch each.
inline std::size_t wordsOf(std::string_view line) {
    std::size_t hash = 14695981039346656037u;  // FNV-1a
    for (const char c : line.substr(line.rfind(':') + 1))
        if (c < '0' || c > '9') hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return hash;
}

enum class Behind { our_code, a_library };

// Reads, and checks what was read.
template <class Read>
void readOrSayWhy(Read&& read, Behind behind = Behind::our_code) {
    try {
        read();
    } catch (const std::runtime_error& error) {
        const std::string_view line = error.what();
        if (behind == Behind::a_library) observe(wordsOf(line));
        require(!line.empty(), "an error says something");
        require(line.find_first_of("\n\r") == std::string_view::npos, "an error is one line");
        require(line.size() < 2000, "an error is not a file");
    }
}

}  // namespace diptych::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
