// SPDX-License-Identifier: MIT
// Processes four pairs of rows at a time, so that sums travel to memory once per eight rows.
#include "compare/metrics/convolve.h"

#include "compare/metrics/fast_math.h"

namespace diptych {

DIPTYCH_WIDE_LANES void convolveEven(float* __restrict out, const float* const* taps, const float* w,
                                     int radius, int n) {
    const float* middle = taps[0];
    for (int i = 0; i < n; ++i) out[i] = w[0] * middle[i];
    int k = 1;
    for (; k + 3 <= radius; k += 4) {
        const float *a0 = taps[k], *a1 = taps[k + 1], *a2 = taps[k + 2], *a3 = taps[k + 3];
        const float *b0 = taps[-k], *b1 = taps[-k - 1], *b2 = taps[-k - 2], *b3 = taps[-k - 3];
        const float w0 = w[k], w1 = w[k + 1], w2 = w[k + 2], w3 = w[k + 3];
        for (int i = 0; i < n; ++i)
            out[i] +=
                (w0 * (a0[i] + b0[i]) + w1 * (a1[i] + b1[i])) + (w2 * (a2[i] + b2[i]) + w3 * (a3[i] + b3[i]));
    }
    for (; k <= radius; ++k) {
        const float *a = taps[k], *b = taps[-k];
        for (int i = 0; i < n; ++i) out[i] += w[k] * (a[i] + b[i]);
    }
}

DIPTYCH_WIDE_LANES void convolveOdd(float* __restrict out, const float* const* taps, const float* w,
                                    int radius, int n) {
    for (int i = 0; i < n; ++i) out[i] = 0;
    int k = 1;
    for (; k + 3 <= radius; k += 4) {
        const float *a0 = taps[k], *a1 = taps[k + 1], *a2 = taps[k + 2], *a3 = taps[k + 3];
        const float *b0 = taps[-k], *b1 = taps[-k - 1], *b2 = taps[-k - 2], *b3 = taps[-k - 3];
        const float w0 = w[k], w1 = w[k + 1], w2 = w[k + 2], w3 = w[k + 3];
        for (int i = 0; i < n; ++i)
            out[i] +=
                (w0 * (a0[i] - b0[i]) + w1 * (a1[i] - b1[i])) + (w2 * (a2[i] - b2[i]) + w3 * (a3[i] - b3[i]));
    }
    for (; k <= radius; ++k) {
        const float *a = taps[k], *b = taps[-k];
        for (int i = 0; i < n; ++i) out[i] += w[k] * (a[i] - b[i]);
    }
}

}  // namespace diptych
