// SPDX-License-Identifier: MIT
// FLIP's arithmetic on rows of pixels. Each component is a plane of its own, so that compilers vectorise
// along the row.
#pragma once

namespace diptych {

// A row in the space that FLIP filters in: relative luminance y, and two opponent colours cx = x - y and
// cz = y - z, where x, y, z are CIE XYZ over the white's. YCxCz (Zhang and Wandell 1997) is
// (116 y - 16, 500 cx, 200 cz), so that filters whose weights add up to 1 may work on these.
struct OpponentRow {
    float *y, *cx, *cz;
};

// Filtered values of one row and the responses of the feature detectors.
struct FilteredRow {
    float *y, *cx, *cz;
    float *edge_x, *edge_y, *point_x, *point_y;
};

enum class ToneMapper { aces, reinhard, hable };

// (k0 x^2 + k1 x) / (k2 x^2 + k3 x + k4).
struct ToneCurve {
    float k0, k1, k2, k3, k4;
};
// aces: Narkowicz 2016, "ACES Filmic Tone Mapping Curve", on 0.6 x; hable: Hable 2010, "Filmic Tonemapping
// Operators", on 2 x and with white at 11.2; reinhard: Reinhard et al. 2002, equation 3, x over 1 +
// luminance.
ToneCurve toneCurve(ToneMapper mapper);

// The x at which the curve reaches `value`, for grey.
double whereCurveReaches(ToneMapper mapper, double value);

// n interleaved RGB pixels of sRGB values, limited to [0, 1], or of linear ones times `scale` through the
// tone mapper, negative ones as 0.
void opponentsFromSrgb(const OpponentRow& out, const float* rgb, int n);
void opponentsFromLinear(const OpponentRow& out, const float* rgb, int n, float scale, ToneMapper mapper);

// What of a filtered row is compared: lightness, two chromas, and the lengths of the detectors' responses.
struct ComparableRow {
    const float *lightness, *a, *b, *edge, *point;
};
// Of n filtered pixels, made in the memory of their row.
ComparableRow comparableRow(const FilteredRow& row, int n);

// FLIP's error of n pixels, in [0, 1]; exactly 0 where they are the same.
void flipErrors(float* out, const ComparableRow& reference, const ComparableRow& test, int n);

}  // namespace diptych
