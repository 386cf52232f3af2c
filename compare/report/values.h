// SPDX-License-Identifier: MIT
// The numbers behind the pictures of one channel, for the page to show under the cursor. A page from file://
// may neither fetch a file nor read a picture back, but it may load a script: so they are one.
#pragma once

#include "shared/image/image.h"

#include <cstddef>
#include <string>

namespace diptych {

// Of one channel; `test` and `errors` (W x H x 1) may be nullptr where only one Frame has it.
struct ChannelValues {
    const Image* baseline;
    const Image* test;
    const Image* errors;
};

// Of larger pictures there are none: their text would come near the longest that browsers take, half a GiB.
inline constexpr std::size_t mostPixelsOfValues = std::size_t{16} << 20;

// diptychValues("NAME", {...}): width, height, components, images (1 or 2), bits, exact, exponent, errorUnit,
// and `data`, base64 of zlib's format of these planes of W x H words of 16 or 32 bits, one after the other:
// the components of baseline; those of test, less the baseline's words; the errors. Of each word its left
// neighbour in the row is taken off (both modulo 2^bits), and a plane is stored by bytes, all lowest ones
// first.
//
// 32 bits: float32, exact, where baseline and test take no more than a MiB of it. 16 bits: float16 of the
// value x 2^exponent, by which the largest magnitude stays below 2^15, so that 11 bits are left of all that
// is no more than 2^29 times smaller; `exact` where no value is changed by it. Errors in 16 bits are in units
// of errorUnit, the largest finite one.
std::string valuesScript(const std::string& name, const ChannelValues& values);

}  // namespace diptych
