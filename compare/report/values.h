// SPDX-License-Identifier: MIT
// The numbers behind the images of one channel, which the page shows under the cursor. They are stored as
// a script, because a page from file:// may neither fetch a file nor read pixels of an image.
#pragma once

#include "shared/image/image.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace diptych {

// `test` and `errors` (W x H x 1) may be nullptr if only one Frame has the channel.
struct ChannelValues {
    const Image* baseline;
    const Image* test;
    const Image* errors;
};

// Larger images get no values: the text would approach half a GiB, the longest string that browsers allow.
inline constexpr std::size_t maxPixelsOfValues = std::size_t{16} << 20;

// diptychValues("NAME", {...}): width, height, components, images (1 or 2), bits, exact, exponent,
// errorUnit and `data`. `data` has one text for each plane of W x H words of 16 or 32 bits,
// zlib-compressed in base 91, empty if all words are 0. The planes are: the components of baseline, each
// word minus its left neighbour in the row; those of test, minus the baseline's words (all modulo 2^bits);
// the errors. A plane is stored by bytes: the lowest bytes of all words first.
//
// 32 bits: exact float32, used if baseline and test take at most 1 MiB. 16 bits: float16 of value x
// 2^exponent, so that the largest magnitude is in [2^14, 2^15). Values down to 2^-29 of it keep 11 bits;
// `exact` if no value changes. Errors in 16 bits are in units of errorUnit, the largest finite one.
//
// Base 91: every 13 bits, the lowest first, become two characters, quotient and remainder by 91, of "#" to
// "~" without the backslash; up to 6 remaining bits become one. Base64 would be a twelfth longer.
//
// The script is passed to `write` in pieces, because it may be larger than the images.
void valuesScript(const std::string& name, const ChannelValues& values,
                  const std::function<void(std::string_view)>& write);

}  // namespace diptych
