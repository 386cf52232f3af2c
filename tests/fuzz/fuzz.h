// SPDX-License-Identifier: MIT
// The contract of every fuzzed reader: any input either is read, with a result that meets its
// postconditions, or ends in one std::runtime_error of one line. Everything else is a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <span>
#include <stdexcept>
#include <string_view>

namespace diptych::fuzz {

// Limit of decoded image bytes, so that no input fails merely by its size.
inline constexpr std::uint64_t max_bytes = std::uint64_t{16} << 20;

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

// Some readers use libraries that are not instrumented. libFuzzer sees none of their branches and would
// keep one input of a thousand kinds. An observed property (a format, an error message) counts as a
// branch.
#ifdef DIPTYCH_FUZZ
__attribute__((section("__libfuzzer_extra_counters"))) static std::uint8_t observed[1024];
inline void observe(std::size_t what) {
    observed[what % sizeof observed] = 1;
}
#else
inline void observe(std::size_t) {}
#endif

// Hash of a message's last part without digits: otherwise each name and size would count as a branch.
inline std::size_t wordsOf(std::string_view line) {
    std::size_t hash = 14695981039346656037u;  // FNV-1a
    for (const char c : line.substr(line.rfind(':') + 1))
        if (c < '0' || c > '9') hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return hash;
}

enum class Behind { our_code, a_library };

// Reads and checks the result; an error must be one short line.
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

// One of the targets that `replay` holds, by name.
struct Target {
    using Function = int(const std::uint8_t* data, std::size_t size);
    static std::map<std::string_view, Function*>& all() {
        static std::map<std::string_view, Function*> targets;
        return targets;
    }
    Target(std::string_view name, Function* function) { all()[name] = function; }
};

}  // namespace diptych::fuzz

// Begins the definition of a target: of the fuzzer's own function, or of one of many in `replay`.
#ifdef DIPTYCH_FUZZ
#define FUZZ_TARGET(name) extern "C" int LLVMFuzzerTestOneInput
#else
#define FUZZ_TARGET(name)                                               \
    static diptych::fuzz::Target::Function name##Target;                \
    static const diptych::fuzz::Target name##_row(#name, name##Target); \
    static int name##Target
#endif
