// SPDX-License-Identifier: MIT
// The numbers behind the pictures of one channel, which the page shows under the cursor. A page from file://
// may neither fetch a file nor read pixels of a picture, but it may load a script, so the numbers are stored
// as one.
#pragma once

#include "shared/image/image.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace diptych {

// Of one channel; `test` and `errors` (W x H x 1) may be nullptr where only one Frame has it.
struct ChannelValues {
    const Image* baseline;
    const Image* test;
    const Image* errors;
};

// Larger pictures get no values: the text would come close to half a GiB, the longest string that browsers
// allow.
inline constexpr std::size_t mostPixelsOfValues = std::size_t{16} << 20;

// diptychValues("NAME", {...}): width, height, components, images (1 or 2), bits, exact, exponent, errorUnit,
// and `data`, a text for each of these planes of W x H words of 16 or 32 bits, in base 91 zlib's format of
// it, empty where all of its words are 0: the components of baseline, each word as the difference to its left
// neighbour in the row; those of test, less the baseline's words (all modulo 2^bits); the errors. A plane is
// stored by bytes: the lowest bytes of all words first.
//
// 32 bits: exact float32, used if baseline and test take at most 1 MiB. 16 bits: float16 of the
// value x 2^exponent, by which the largest magnitude stays below 2^15, so that 11 bits are left of all that
// is no more than 2^29 times smaller; `exact` where no value is changed by it. Errors in 16 bits are in units
// of errorUnit, the largest finite one.
//
// Base 91: every 13 bits, the lowest first, are two characters, quotient and remainder by 91, of "#" to "~"
// without the backslash; of up to 6 bits that are left, one. Base64 takes a twelfth more.
//
// The script is given to `write` piece by piece, since it may be larger than the pictures.
void valuesScript(const std::string& name, const ChannelValues& values,
                  const std::function<void(std::string_view)>& write);

}  // namespace diptych
