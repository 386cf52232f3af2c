// SPDX-License-Identifier: MIT
// Convolution of rows. Vertical if the taps are an image's rows, horizontal if they are shifts of one row.
#pragma once

namespace diptych {

// out[i] = w[0] taps[0][i] + sum over k of w[k] (taps[k][i] + taps[-k][i]), k = 1 .. radius, for n values.
// `taps` points to the middle of 2 radius + 1 rows, none of which may be `out`.
void convolveEven(float* out, const float* const* taps, const float* w, int radius, int n);
// out[i] = sum over k of w[k] (taps[k][i] - taps[-k][i]).
void convolveOdd(float* out, const float* const* taps, const float* w, int radius, int n);

}  // namespace diptych
