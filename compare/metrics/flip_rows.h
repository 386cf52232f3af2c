// SPDX-License-Identifier: MIT
// FLIP's arithmetic on rows of pixels, one plane per component, so that compilers vectorize.
#pragma once

namespace diptych {

// A row in FLIP's filter space: relative luminance y, and opponent colours cx = x - y and cz = y - z,
// where x, y, z are CIE XYZ relative to white. YCxCz (Zhang and Wandell 1997) is (116 y - 16, 500 cx, 200
// cz), so filters whose weights add up to 1 can work on these.
struct OpponentRow {
    float *y, *cx, *cz;
};

// Filtered values of a row, and responses of the feature detectors.
struct FilteredRow {
    float *y, *cx, *cz;
    float *edge_x, *edge_y, *point_x, *point_y;
};

enum class ToneMapper { aces, reinhard, hable };

// (k0 x^2 + k1 x) / (k2 x^2 + k3 x + k4).
struct ToneCurve {
    float k0, k1, k2, k3, k4;
};
// aces: Narkowicz 2016, "ACES Filmic Tone Mapping Curve", of 0.6 x; hable: Hable 2010, "Filmic Tonemapping
// Operators", of 2 x, with white at 11.2; reinhard: Reinhard et al. 2002, equation 3, x / (1 + luminance).
ToneCurve toneCurve(ToneMapper mapper);

// The grey x at which the curve reaches `value`.
double inverseToneCurve(ToneMapper mapper, double value);

// Converts n interleaved RGB pixels: sRGB values clamped to [0, 1]; or linear ones times `scale`, tone
// mapped, negative ones as 0.
void opponentsFromSrgb(const OpponentRow& out, const float* rgb, int n);
void opponentsFromLinear(const OpponentRow& out, const float* rgb, int n, float scale, ToneMapper mapper);

// The compared values of a filtered row: lightness, two chromas, and the lengths of the detectors'
// responses.
struct ComparableRow {
    const float *lightness, *a, *b, *edge, *point;
};
// Computed in the row's own memory.
ComparableRow comparableRow(const FilteredRow& row, int n);

// FLIP's error of n pixels, in [0, 1]; exactly 0 for equal ones.
void flipErrors(float* out, const ComparableRow& reference, const ComparableRow& test, int n);

}  // namespace diptych
