// SPDX-License-Identifier: MIT
// A .glb stores its own length and that of its chunks, so inserting a byte would make it invalid. Most
// mutations change the JSON or the rest separately and correct the lengths.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max,
                                               unsigned int seed) {
    constexpr std::size_t head = 20;  // headers of the file and of its first chunk
    const auto wordAt = [&](std::size_t at) {
        std::uint32_t word;
        std::memcpy(&word, data + at, sizeof word);
        return std::size_t{word};
    };
    const auto put = [&](std::size_t at, std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        std::memcpy(data + at, &word, sizeof word);
    };
    if (size < head || std::memcmp(data, "glTF", 4) != 0 || seed % 8 == 0 || max < size ||
        wordAt(12) > size - head)
        return LLVMFuzzerMutate(data, size, max);

    const std::size_t json = wordAt(12);
    if (seed % 8 < 3 && size > head + json) {
        const std::size_t rest = head + json;
        size = rest + LLVMFuzzerMutate(data + rest, size - rest, max - rest);
        if (size >= rest + 8 && seed % 2 == 0) put(rest, size - rest - 8);
    } else {
        const std::vector<std::uint8_t> rest(data + head + json, data + size);
        std::size_t mutated = LLVMFuzzerMutate(data + head, json, max - head - rest.size());
        while (mutated % 4 != 0 && head + mutated + rest.size() < max) data[head + mutated++] = ' ';
        put(12, mutated);
        std::copy(rest.begin(), rest.end(), data + head + mutated);
        size = head + mutated + rest.size();
    }
    put(8, size);
    return size;
}
