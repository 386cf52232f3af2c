// SPDX-License-Identifier: MIT
#include "compare/metrics/flip_rows.h"

#include "compare/metrics/fast_math.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

constexpr Matrix inverse(const Matrix& m) {
    Matrix r{};
    double determinant = 0;
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned j = 0; j < 3; ++j) {
            const unsigned a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            r[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
            if (j == 0) determinant += r[i][j] * m[j][i];
        }
    for (auto& row : r)
        for (double& v : row) v /= determinant;
    return r;
}

// Linear sRGB to CIE XYZ relative to white, from the chromaticities of IEC 61966-2-1 (primaries of
// Rec.709, D65 at x 0.3127, y 0.3290): each row adds up to 1.
constexpr Matrix xyzFromRgb = [] {
    constexpr double x[] = {0.64, 0.30, 0.15}, y[] = {0.33, 0.60, 0.06};
    constexpr double white[] = {0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};
    Matrix primaries{};
    for (unsigned c = 0; c < 3; ++c) {
        primaries[0][c] = x[c] / y[c];
        primaries[1][c] = 1;
        primaries[2][c] = (1 - x[c] - y[c]) / y[c];
    }
    const Matrix solve = inverse(primaries);
    Matrix m{};
    for (unsigned c = 0; c < 3; ++c) {
        const double scale = solve[c][0] * white[0] + solve[c][1] * white[1] + solve[c][2] * white[2];
        for (unsigned i = 0; i < 3; ++i) m[i][c] = primaries[i][c] * scale / white[i];
    }
    return m;
}();
constexpr Matrix rgbFromXyz = inverse(xyzFromRgb);

struct Triple {
    float a, b, c;
};

constexpr Triple times(const Matrix& m, const Triple& v) {
    const auto row = [&](const std::array<double, 3>& r) {
        return static_cast<float>(r[0]) * v.a + static_cast<float>(r[1]) * v.b +
               static_cast<float>(r[2]) * v.c;
    };
    return {row(m[0]), row(m[1]), row(m[2])};
}

inline float unit(float v) {
    v = v < 0 ? 0.0f : v;
    return v > 1 ? 1.0f : v;
}

// IEC 61966-2-1.
inline float linearFromSrgb(float v) {
    const float curve = fast::pow((v + 0.055f) / 1.055f, 2.4f), line = v / 12.92f;
    return v <= 0.04045f ? line : curve;
}

inline void store(const OpponentRow& out, int i, const Triple& rgb) {
    const Triple xyz = times(xyzFromRgb, rgb);
    out.y[i] = xyz.b;
    out.cx[i] = xyz.a - xyz.b;
    out.cz[i] = xyz.b - xyz.c;
}

// CIELAB's f: a cube root above (6/29)^3, linear below.
inline float labCurve(float t) {
    constexpr float delta = 6.0f / 29;
    const float root = fast::pow(t, 1.0f / 3), line = t / (3 * delta * delta) + 4.0f / 29;
    return t > delta * delta * delta ? root : line;
}

// CIELAB with chroma scaled by lightness, for the Hunt effect (Andersson et al. 2020, section 4.1.2).
inline Triple huntLab(const Triple& xyz) {
    const float fx = labCurve(xyz.a), fy = labCurve(xyz.b), fz = labCurve(xyz.c);
    const float lightness = 116 * fy - 16;
    return {lightness, 0.01f * lightness * 500 * (fx - fy), 0.01f * lightness * 200 * (fy - fz)};
}

// Converts rows y, cx, cz to lightness and chroma, in place.
DIPTYCH_WIDE_LANES void labInPlace(float* __restrict y, float* __restrict cx, float* __restrict cz, int n) {
    for (int i = 0; i < n; ++i) {
        const Triple rgb = times(rgbFromXyz, {cx[i] + y[i], y[i], y[i] - cz[i]});
        const Triple lab = huntLab(times(xyzFromRgb, {unit(rgb.a), unit(rgb.b), unit(rgb.c)}));
        y[i] = lab.a;
        cx[i] = lab.b;
        cz[i] = lab.c;
    }
}

inline float magnitude(float a, float b) {
    return std::sqrt(a * a + b * b);
}
inline float absoluteDifference(float a, float b) {
    return a < b ? b - a : a - b;
}

// HyAB (Abasi et al. 2020).
inline float hyab(const Triple& p, const Triple& q) {
    return absoluteDifference(p.a, q.a) + magnitude(p.b - q.b, p.c - q.c);
}

constexpr float qc = 0.7f, pc = 0.4f, pt = 0.95f, qf = 0.5f;  // Andersson et al. 2020, sections 4.1.3 and 4.2

// The largest distance of two sRGB colours, green and blue, after the power qc.
float largestColorDistance() {
    static const float largest =
        std::pow(hyab(huntLab(times(xyzFromRgb, {0, 1, 0})), huntLab(times(xyzFromRgb, {0, 0, 1}))), qc);
    return largest;
}

// Maps distances up to pc of the largest to [0, pt], and the rest to [pt, 1].
inline float colorError(float distance, float largest) {
    const float d = fast::pow(distance, qc), knee = pc * largest;
    const float low = d * (pt / knee), high = pt + (d - knee) * ((1 - pt) / (largest - knee));
    return unit(d < knee ? low : high);
}

// Replaces ax by the lengths of (ax, ay).
DIPTYCH_WIDE_LANES void lengthsInPlace(float* __restrict ax, const float* __restrict ay, int n) {
    for (int i = 0; i < n; ++i) ax[i] = magnitude(ax[i], ay[i]);
}

DIPTYCH_WIDE_LANES void errorsOfComparable(float* __restrict out, const ComparableRow r,
                                           const ComparableRow t, int n, float largest) {
    static_assert(qf == 0.5f, "the power is a square root");
    for (int i = 0; i < n; ++i) {
        const float distance = hyab({r.lightness[i], r.a[i], r.b[i]}, {t.lightness[i], t.a[i], t.b[i]});
        const float edge = absoluteDifference(r.edge[i], t.edge[i]);
        const float point = absoluteDifference(r.point[i], t.point[i]);
        const float feature = std::sqrt((edge < point ? point : edge) * 0.707106781f);
        out[i] = unit(fast::pow(colorError(distance, largest), 1 - unit(feature)));
    }
}

// Clamps x to [0, `max`]: above it every curve exceeds 1, and squares might overflow.
inline float limited(float x, float max) {
    x = x < 0 ? 0.0f : x;
    return x > max ? max : x;
}

inline float onCurve(const ToneCurve& k, float x) {
    return unit((k.k0 * x + k.k1) * x / ((k.k2 * x + k.k3) * x + k.k4));
}

DIPTYCH_WIDE_LANES void opponentsOnCurve(const OpponentRow& out, const float* __restrict rgb, int n,
                                         float scale, const ToneCurve curve) {
    for (int i = 0; i < n; ++i) {
        const float* p = rgb + 3 * i;
        store(out, i,
              {onCurve(curve, limited(p[0] * scale, 1e4f)), onCurve(curve, limited(p[1] * scale, 1e4f)),
               onCurve(curve, limited(p[2] * scale, 1e4f))});
    }
}

DIPTYCH_WIDE_LANES void opponentsByReinhard(const OpponentRow& out, const float* __restrict rgb, int n,
                                            float scale) {
    for (int i = 0; i < n; ++i) {
        const float* p = rgb + 3 * i;
        const Triple c{limited(p[0] * scale, 1e30f), limited(p[1] * scale, 1e30f),
                       limited(p[2] * scale, 1e30f)};
        const float shown = 1 / (1 + 0.2126f * c.a + 0.7152f * c.b + 0.0722f * c.c);
        store(out, i, {unit(c.a * shown), unit(c.b * shown), unit(c.c * shown)});
    }
}

}  // namespace

ToneCurve toneCurve(ToneMapper mapper) {
    switch (mapper) {
        case ToneMapper::aces:
            return {0.6f * 0.6f * 2.51f, 0.6f * 0.03f, 0.6f * 0.6f * 2.43f, 0.6f * 0.59f, 0.14f};
        case ToneMapper::reinhard:
            return {0, 1, 0, 1, 1};
        case ToneMapper::hable: {
            constexpr double a = 0.15, b = 0.5, c = 0.1, d = 0.2, e = 0.02, f = 0.3, white = 11.2, bias = 2;
            constexpr double square = a - e * a / f, linear = c * b - e * b / f;
            constexpr double peak = (square * white + linear) * white / ((a * white + b) * white + d * f);
            return {static_cast<float>(square * bias * bias / peak), static_cast<float>(linear * bias / peak),
                    static_cast<float>(a * bias * bias), static_cast<float>(b * bias),
                    static_cast<float>(d * f)};
        }
    }
    return {};
}

double inverseToneCurve(ToneMapper mapper, double value) {
    const ToneCurve k = toneCurve(mapper);
    const double square = k.k0 - value * k.k2, linear = k.k1 - value * k.k3, constant = -value * k.k4;
    if (square == 0) return -constant / linear;
    return (-linear + std::sqrt(linear * linear - 4 * square * constant)) / (2 * square);
}

DIPTYCH_WIDE_LANES void opponentsFromSrgb(const OpponentRow& out, const float* __restrict rgb, int n) {
    for (int i = 0; i < n; ++i) {
        const float* p = rgb + 3 * i;
        store(out, i, {linearFromSrgb(unit(p[0])), linearFromSrgb(unit(p[1])), linearFromSrgb(unit(p[2]))});
    }
}

void opponentsFromLinear(const OpponentRow& out, const float* rgb, int n, float scale, ToneMapper mapper) {
    if (mapper == ToneMapper::reinhard)
        opponentsByReinhard(out, rgb, n, scale);
    else
        opponentsOnCurve(out, rgb, n, scale, toneCurve(mapper));
}

ComparableRow comparableRow(const FilteredRow& row, int n) {
    labInPlace(row.y, row.cx, row.cz, n);
    lengthsInPlace(row.edge_x, row.edge_y, n);
    lengthsInPlace(row.point_x, row.point_y, n);
    return {row.y, row.cx, row.cz, row.edge_x, row.point_x};
}

void flipErrors(float* out, const ComparableRow& reference, const ComparableRow& test, int n) {
    errorsOfComparable(out, reference, test, n, largestColorDistance());
}

}  // namespace diptych
