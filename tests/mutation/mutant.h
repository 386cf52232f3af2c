// SPDX-License-Identifier: MIT
// Switches of mutate.py's edits, in C++ and GLSL: DIPTYCH_MUTANT(7u) is true if the environment variable
// DIPTYCH_MUTANT lists 7, as in "2,7". Shaders compare a specialization constant (diptychModule).
#ifndef DIPTYCH_TESTS_MUTANT_H
#define DIPTYCH_TESTS_MUTANT_H
#ifndef __cplusplus
layout(constant_id = 2000) const uint diptych_mutant = 0u;
#define DIPTYCH_MUTANT(n) (diptych_mutant == n)
#else
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <span>
#include <vector>

inline bool diptychChosen(std::uint32_t n) {
    static const std::vector<bool> chosen = [] {
        std::vector<bool> all(1 << 16);
        const char* text = std::getenv("DIPTYCH_MUTANT");
        for (char* end; text && *text; text = *end ? end + 1 : end)
            all[std::strtoul(text, &end, 10) & 0xffff] = true;
        return all;
    }();
    return chosen[n & 0xffff];
}
// Marks an edit as reached in the file DIPTYCH_REACHED, which keeps it even if the process is killed.
inline void diptychReach(std::uint32_t n) {
    static auto* const bytes = [] {
        const char* const file = std::getenv("DIPTYCH_REACHED");
        const int opened = file ? ::open(file, O_RDWR | O_CLOEXEC) : -1;
        void* const there = ::mmap(nullptr, 1 << 16, PROT_READ | PROT_WRITE, MAP_SHARED, opened, 0);
        if (opened >= 0) ::close(opened);
        return there == MAP_FAILED ? nullptr : static_cast<unsigned char*>(there);
    }();
    if (bytes) bytes[n & 0xffff] = 1;
}
#define DIPTYCH_MUTANT(n) (::diptychReach(n), ::diptychChosen(n))

// Decides a module's switches: a chosen one compares the constant with itself. Marks all as reached.
inline std::vector<std::uint32_t> diptychModule(std::span<const std::uint32_t> module) {
    std::vector<std::uint32_t> words(module.begin(), module.begin() + 5);
    std::map<std::uint32_t, std::uint32_t> constants;
    std::uint32_t id = 0;
    for (std::size_t at = 5; at < module.size(); at += module[at] >> 16) {
        const auto in = module.subspan(at, module[at] >> 16);
        const std::uint32_t op = in[0] & 0xffff;
        if (op == 71 && in[2] == 1 && in[3] == 2000)
            id = in[1];  // OpDecorate SpecId
        else
            words.insert(words.end(), in.begin(), in.end());
        if (op == 43) constants[in[2]] = in[3];                                          // OpConstant
        if (op == 50 && in[2] == id) words.end()[-4] = 4u << 16 | 43, words.back() = 0;  // OpSpecConstant
        if (op == 52 && (in[3] | 1) == 171 && in[4] == id) {  // OpIEqual, OpINotEqual
            diptychReach(constants[in[5]]);
            if (diptychChosen(constants[in[5]])) words.back() = id;  // equal to itself
        }
    }
    return words;
}
auto diptychCreateShaderModule(auto device, const auto* info, auto allocator, auto* module) {
    const auto words = diptychModule({info->pCode, info->codeSize / 4});
    auto set = *info;
    set.codeSize = 4 * words.size();
    set.pCode = words.data();
    return vkCreateShaderModule(device, &set, allocator, module);
}
#endif
#endif
