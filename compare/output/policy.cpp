// SPDX-License-Identifier: MIT
#include "compare/output/policy.h"

#include "compare/files/data_uri.h"
#include "shared/text/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace diptych {
namespace {

// SHA-256 (FIPS 180-4, 6.2), the hash that browsers compare.
std::string sha256(std::string_view text) {
    constexpr std::array<std::uint32_t, 64> k{
        0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
        0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
        0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
        0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
        0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
        0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
        0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
        0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};
    std::array<std::uint32_t, 8> hash{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::string bytes(text);
    bytes += '\x80';
    bytes.append((119 - text.size() % 64) % 64, '\0');
    const std::uint64_t bits = std::uint64_t{text.size()} * 8;
    for (int shift = 56; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 255);
    for (std::size_t block = 0; block < bytes.size(); block += 64) {
        std::array<std::uint32_t, 64> w{};
        for (std::size_t i = 0; i < 64; ++i)
            w[i / 4] = w[i / 4] << 8 | static_cast<unsigned char>(bytes[block + i]);
        for (std::size_t i = 16; i < 64; ++i) {
            const std::uint32_t a = w[i - 15], b = w[i - 2];
            w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + w[i - 7] +
                   (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
        }
        std::array<std::uint32_t, 8> s = hash;
        for (std::size_t i = 0; i < 64; ++i) {
            const auto [a, b, c, d, e, f, g, h] = s;
            const std::uint32_t one = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                      ((e & f) ^ (~e & g)) + k[i] + w[i];
            const std::uint32_t two =
                (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
            s = {one + two, a, b, c, d + one, e, f, g};
        }
        for (std::size_t i = 0; i < 8; ++i) hash[i] += s[i];
    }
    std::string digest;
    for (const std::uint32_t word : hash)
        for (const int shift : {24, 16, 8, 0}) digest += static_cast<char>(word >> shift & 255);
    return digest;
}

}  // namespace

std::string scriptSource(std::string_view script) {
    return fmt::format("'sha256-{}'", base64(sha256(script)));
}

// strict-dynamic: only the script may add scripts; a file's location grants nothing. Images are beside the
// page, on disk or on a server, or embedded in it.
std::string pagePolicy(std::string_view script) {
    return fmt::format(
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src {} "
        "'strict-dynamic'; style-src 'unsafe-inline'; img-src 'self' file: data:; base-uri 'none'; "
        "form-action 'none'\">",
        scriptSource(script));
}

bool isDataScript(std::string_view script) {
    constexpr std::string_view end = ");\n";
    for (const std::string_view call : {"diptychSection(", "diptychValues("})
        if (script.starts_with(call) && script.ends_with(end)) {
            script.remove_prefix(call.size());
            script.remove_suffix(std::min(end.size(), script.size()));
            try {
                checkJson(fmt::format("[{}]", script));
                return true;
            } catch (const std::runtime_error&) {
                return false;
            }
        }
    return false;
}

}  // namespace diptych
