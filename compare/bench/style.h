// SPDX-License-Identifier: MIT
#pragma once

namespace diptych::bench {

extern const char* const benchStyle;  // bench.css, embedded at build time

}  // namespace diptych::bench
