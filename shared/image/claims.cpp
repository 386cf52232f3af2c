// SPDX-License-Identifier: MIT
#include "shared/image/claims.h"

#include "shared/text/fail.h"

#include <fmt/format.h>

#include <atomic>

namespace diptych {

Claim claimMemory(std::uint64_t bytes, std::uint64_t held, const std::string& what) {
    constexpr std::uint64_t max = std::uint64_t{2} << 30, ratio = 64;
    static std::atomic<std::uint64_t> all = 0;
    if (bytes / ratio + (bytes % ratio > 0) <= held) return {};
    const std::uint64_t claimed = bytes - ratio * held, before = all.fetch_add(claimed);
    if (before > max || claimed > max - before) {
        all -= claimed;
        fail(what, fmt::format("takes {} MiB, claimed by {} bytes{}; the limit of such claims is {} MiB",
                               bytes >> 20, held,
                               before > 0 ? fmt::format(", beside {} MiB claimed before", before >> 20) : "",
                               max >> 20));
    }
    static constexpr int none = 0;
    return {&none, [claimed](const void*) { all -= claimed; }};
}

}  // namespace diptych
