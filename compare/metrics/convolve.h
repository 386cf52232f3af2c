// SPDX-License-Identifier: MIT
// Weighted sums of rows: along a column when the rows are a picture's, along a row when they are one row,
// shifted.
#pragma once

namespace diptych {

// out[i] = w[0] taps[0][i] + sum over k of w[k] (taps[k][i] + taps[-k][i]), k = 1 .. radius; n values.
// `taps` points at the middle one of 2 radius + 1 rows, none of which is `out`.
void convolveEven(float* out, const float* const* taps, const float* w, int radius, int n);
// out[i] = sum over k of w[k] (taps[k][i] - taps[-k][i]).
void convolveOdd(float* out, const float* const* taps, const float* w, int radius, int n);

}  // namespace diptych
