// SPDX-License-Identifier: MIT
// Build tool: exact_spirv FILE.spv
// Decorates every floating-point operation of a module with NoContraction, in place. The GLSL equivalent,
// `precise`, is needed at every variable and does not extend into called functions. glslangValidator 12
// never emits it for dot().
#include "shaders/tool/spirv_words.h"

#include <cstdio>
#include <set>

namespace {

constexpr std::uint32_t opDecorate = 71, noContraction = 42;
// Types and constants, the first section after the decorations.
constexpr std::uint32_t opTypeFirst = 19, opConstantLast = 52;

// OpFNegate, OpFAdd, OpFSub, OpFMul, OpFDiv, OpFRem, OpFMod, and vector and matrix products up to OpDot.
bool isOperation(std::uint32_t op) {
    return op == 127 || op == 129 || op == 131 || op == 133 || op == 136 || (op >= 140 && op <= 148);
}

Words exact(const Words& words) {
    std::set<std::uint32_t> decorated;
    for (std::size_t i = 5; i < words.size(); i += words[i] >> 16)
        if ((words[i] & 0xffff) == opDecorate && words[i + 2] == noContraction)
            decorated.insert(words[i + 1]);
    std::size_t index = 0;
    Words decorations;
    for (std::size_t i = 5; i < words.size(); i += words[i] >> 16) {
        const std::uint32_t op = words[i] & 0xffff;
        if (index == 0 && op >= opTypeFirst && op <= opConstantLast) index = i;
        if (isOperation(op) && decorated.insert(words[i + 2]).second)
            decorations.insert(decorations.end(), {3u << 16 | opDecorate, words[i + 2], noContraction});
    }
    Words result = words;
    result.insert(result.begin() + static_cast<std::ptrdiff_t>(index), decorations.begin(),
                  decorations.end());
    return result;
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) throw std::runtime_error("usage: exact_spirv FILE.spv");
    const Words words = exact(readModule(argv[1]));
    std::ofstream out(argv[1], std::ios::binary);
    out.write(reinterpret_cast<const char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
    out.close();
    if (!out) throw std::runtime_error("cannot write " + std::string(argv[1]));
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "exact_spirv: %s\n", e.what());
    return 2;
}
