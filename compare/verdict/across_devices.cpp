// SPDX-License-Identifier: MIT
#include "compare/verdict/across_devices.h"

#include "compare/metrics/pixel.h"
#include "compare/verdict/encoding_bits.h"
#include "compare/verdict/neighbours.h"
#include "shared/contract/debug_mode.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace diptych {
namespace {

constexpr double roundoff = 0x1p-24;  // of one float32 operation

// Operations between a vertex and a value that is interpolated at a pixel: transform, division, plane
// equation, perspective.
constexpr double interpolatingOperations = 32;
// Vulkan grants a division 2.5 ULP and a product or sum half of one.
constexpr double ulpsOfOperation = 2.5;

// The four differences of places a pixel apart, of which a triangle's normal is the cross product, have some
// seven operations each.
constexpr double operationsOfFacet = 28;

// A vertex a step of the sub-pixel grid elsewhere moves an edge by as much, so that this share of the pixels
// that it crosses changes sides. A pixel beside an edge lies between two of a triangle.
constexpr double edgesOfPixel = 2;
constexpr std::uint64_t fewPixels = 8;  // chance decides of so few

// A triangle that ends half-way to the next pixel, beyond which nothing changes, changes by twice of what is
// seen.
constexpr double kink = 2;

enum class Kind { id, step, place, facet, surface, light, seen, list };

Kind kindOf(const DebugMode& mode) {
    switch (static_cast<gpu::uint>(mode.number)) {
        case gpu::DEBUG_depth:
        case gpu::DEBUG_position:
        case gpu::DEBUG_texcoords:
        case gpu::DEBUG_tangent:
        case gpu::DEBUG_lit_haze:
        case gpu::DEBUG_transmittance:
            return Kind::place;
        case gpu::DEBUG_geometric_normal:
            return Kind::facet;
        case gpu::DEBUG_shadow_visibility:
        case gpu::DEBUG_local_visibility:
            return Kind::seen;
        case gpu::DEBUG_light_count:
        case gpu::DEBUG_list_overflow:
        case gpu::DEBUG_shaded_samples:
            return Kind::list;
        case gpu::DEBUG_material_id:
            return Kind::id;
        default:
            return isLit(mode.number)             ? Kind::light
                   : mode.metric == Metric::exact ? Kind::step
                                                  : Kind::surface;
    }
}

// Calls visit(pixel, bit) for the pixels around one.
template <class Visit>
void aroundPixel(const Image& image, std::size_t pixel, const Visit& visit) {
    const auto width = static_cast<std::size_t>(image.width);
    const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
    around(image, x, y, [&](int u, int v) {
        const int place = (v - y + 1) * 3 + (u - x + 1);
        visit(indexOf(image, u, v), 1u << (place > 4 ? place - 1 : place));
    });
}
// Bits of the neighbours across and down.
constexpr unsigned across_bits = 1u << 3 | 1u << 4, down_bits = 1u << 1 | 1u << 6;

// The steps of both devices' grids.
double stepOf(const AcrossDevices& across, unsigned DevicePrecision::*bits) {
    return std::ldexp(1.0, -static_cast<int>(across.devices[0].*bits)) +
           std::ldexp(1.0, -static_cast<int>(across.devices[1].*bits));
}

// Pixels of a radian at the pixel's depth.
double pixelsPerRadian(const Frame& frame, std::size_t i) {
    const double height = frame.settings.size.height;
    if (frame.camera.fov_degrees > 0)
        return height / (2 * std::tan(frame.camera.fov_degrees / degreesPerRadian / 2));
    const Image* const depth = findChannel(frame, gpu::DEBUG_depth);
    return depth && frame.camera.ymag > 0 ? *depth->pixel(i) * height / (2 * frame.camera.ymag) : height;
}

// Whether a pixel lies beside another surface, or another triangle's plane.
bool isBesideEdge(const SurfaceAround& frame, const Image& ids, const Image* normals, std::size_t i,
                  double facet) {
    bool found = false;
    aroundPixel(ids, i, [&](std::size_t j, unsigned) {
        found = found || !frame.same(i, j) ||
                (normals && metrics::angle(normals->pixel(i), normals->pixel(j)) > facet);
    });
    return found;
}

// Whether texture coordinates jump beside a pixel: to one side far more than to the other.
bool isBesideSeam(const Image& uv, std::size_t i) {
    constexpr double even = 4;
    const auto width = static_cast<std::size_t>(uv.width);
    const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}}) {
        if (x < 1 || y < 1 || x + 1 >= uv.width || y + 1 >= uv.height) return true;
        const double a = metrics::distance(uv.pixel(indexOf(uv, x + dx, y + dy)), uv.pixel(i), 2),
                     b = metrics::distance(uv.pixel(indexOf(uv, x - dx, y - dy)), uv.pixel(i), 2);
        if (std::max(a, b) > even * std::min(a, b) + 1e-5) return true;
    }
    return false;
}

// By how much steeper the pixel's own triangle is than what its neighbours show of it: of triangles that are
// smaller than a pixel, and at outlines. At least 1.
class Steepness {
public:
    explicit Steepness(const Frame& frame)
        : frame_(frame),
          depth_(findChannel(frame, gpu::DEBUG_depth)),
          position_(findChannel(frame, gpu::DEBUG_position)),
          normal_(findChannel(frame, gpu::DEBUG_geometric_normal)) {
        const FrameCamera& c = frame.camera;
        for (int i = 0; i < 3; ++i) forward_[i] = c.target[i] - c.eye[i];
        normalize(forward_);
        right_ = cross(forward_, {c.up[0], c.up[1], c.up[2]});
        normalize(right_);
        up_ = cross(right_, forward_);
    }

    // What depth changes by to the next pixel on the triangle's plane, m; `step`: and beyond so much of it.
    double slope(std::size_t i, double step) const {
        if (!depth_ || !position_ || !normal_ || *depth_->pixel(i) <= 0) return 0;
        const float *n = normal_->pixel(i), *p = position_->pixel(i);
        const double z = *depth_->pixel(i), pixel = z / pixelsPerRadian(frame_, i);
        double facing = 0;
        for (int c = 0; c < 3; ++c)
            facing += double{n[c]} * (frame_.camera.fov_degrees > 0 ? double{p[c]} / z : forward_[c]);
        const double across = pixel * (std::abs(dot(n, right_)) + std::abs(dot(n, up_)));
        const double left = std::abs(facing) - step * across / z;
        return left > 0 ? across / left : std::numeric_limits<double>::infinity();
    }

private:
    using Vector = std::array<double, 3>;
    static double dot(const float* a, const Vector& b) {
        return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
    }
    static Vector cross(const Vector& a, const Vector& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static void normalize(Vector& v) {
        const double length = std::hypot(v[0], v[1], v[2]);
        for (double& c : v) c = length > 0 ? c / length : 0;
    }

    const Frame& frame_;
    const Image *depth_, *position_, *normal_;
    Vector forward_{}, right_{}, up_{};
};

// How far apart a triangle's normal may be, degrees: its places are rounded as parts of their distance, and
// both pictures pack it.
class FacetBound {
public:
    explicit FacetBound(const FramePair& pair)
        : frame_(pair.baseline), packed_(2 * encodingBound(debugMode(gpu::DEBUG_geometric_normal), pair)) {}
    double operator()(std::size_t i) const {
        return 2 * operationsOfFacet * roundoff * pixelsPerRadian(frame_, i) * degreesPerRadian + packed_;
    }

private:
    const Frame& frame_;
    double packed_;
};

double relativeRounding() {
    return 2 * interpolatingOperations * ulpsOfOperation * roundoff;
}

// The relative distance of the two devices' decoding of sRGB codes, by the least code of them (a factor may
// have darkened a texel, never brightened it): what was measured, and no more than Vulkan allows, half a code
// each.
std::array<double, 256> decodeShares(const AcrossDevices& across) {
    std::array<double, 256> shares{};
    const auto &a = across.devices[0].texels, &b = across.devices[1].texels;
    double most = 0;
    for (std::size_t code = 255; code > 0; --code) {
        const double exact = exactSrgb(code), code_step = exact - exactSrgb(code - 1),
                     allowed = code < 255 ? std::max(code_step, exactSrgb(code + 1) - exact) : code_step,
                     measured = a && b ? std::abs(double{a->srgb[code]} - double{b->srgb[code]}) : allowed;
        most = std::max(most, std::min(allowed, measured) / exact);
        shares[code] = most;
    }
    shares[0] = most;
    return shares;
}

// What both devices' filters round texels of 8 bits by: what was measured, and no more than a code each.
double filterRounding(const AcrossDevices& across, bool srgb) {
    double sum = 0;
    for (const DevicePrecision& device : across.devices)
        sum += !device.texels
                   ? 1.0 / 255
                   : std::min(1.0 / 255,
                              (srgb ? device.texels->srgb_filter : device.texels->linear_filter).rounding);
    return sum;
}

// What a channel that is interpolated may differ by: a vertex a step elsewhere moves the place by as much of
// a pixel, and never as far as the next. On triangles narrower than two pixels, which the step turns as well,
// it is what changes to the next pixels of the material.
class PlaceBound {
public:
    PlaceBound(const DebugMode& mode, const FramePair& pair, const Image& baseline, const Image& test)
        : mode_(mode),
          grid_(*pair.grid),
          images_{&baseline, &test},
          step_(kink * stepOf(*pair.across, &DevicePrecision::sub_pixel_bits)) {}

    // In the channel's unit.
    double operator()(std::size_t i) const {
        if (grid_.narrow[i] != 0) {
            const unsigned seen = grid_.material[i];
            if ((seen & across_bits) == 0 || (seen & down_bits) == 0)
                return std::numeric_limits<double>::infinity();
            return std::max(change(*images_[0], i, seen), change(*images_[1], i, seen));
        }
        // The smaller of both pictures', so that what is wrong in one of them does not widen what it is held
        // to.
        const unsigned seen = grid_.surface[i];
        const double changes = std::min(change(*images_[0], i, seen), change(*images_[1], i, seen));
        return std::min(1.0, step_ * double{grid_.steeper[i]}) * changes;
    }

private:
    double change(const Image& image, std::size_t i, unsigned seen) const {
        double most = 0;
        aroundPixel(image, i, [&](std::size_t j, unsigned bit) {
            if ((seen & bit) == 0) return;
            const double to = apart(mode_, image.pixel(i), image.pixel(j));
            if (std::isfinite(to)) most = std::max(most, to);
        });
        return most;
    }

    const DebugMode& mode_;
    const SurfaceGrid& grid_;
    std::array<const Image*, 2> images_;
    double step_;
};

// Whether a pixel shows the same share of a light that casts in both pictures, and whether it lies beside the
// edge of a shadow in either.
class Shadowed {
public:
    explicit Shadowed(const FramePair& pair) {
        for (const gpu::uint mode : {gpu::DEBUG_shadow_visibility, gpu::DEBUG_local_visibility})
            if (const Image* a = findChannel(pair.baseline, mode), *b = findChannel(pair.test, mode); a && b)
                images_.push_back({a, b});
    }
    bool differs(std::size_t i) const {
        return std::ranges::any_of(images_, [i](const auto& of) { return apart(*of[0], i, *of[1], i); });
    }
    // By what share light may differ that is seen to shares that do not differ by more.
    double relative(std::size_t i) const {
        double share = 0;
        for (const auto& [a, b] : images_)
            if (const double least = std::min(*a->pixel(i), *b->pixel(i)); least > 0)
                share += metrics::distance(*a->pixel(i), *b->pixel(i)) / least;
        return share;
    }
    bool isBesideEdge(std::size_t i) const {
        bool found = false;
        for (const auto& of : images_)
            for (const Image* image : of)
                aroundPixel(*image, i,
                            [&](std::size_t j, unsigned) { found = found || apart(*image, i, *image, j); });
        return found;
    }

private:
    static bool apart(const Image& a, std::size_t i, const Image& b, std::size_t j) {
        const float p = *a.pixel(i), q = *b.pixel(j);
        return metrics::distance(p, q) > 2 * shadingRounding || (p == 0) != (q == 0);
    }
    std::vector<std::array<const Image*, 2>> images_;
};

// The tolerance of each pixel.
class DeviceBounds {
public:
    DeviceBounds(const DebugMode& mode, const FramePair& pair)
        : mode_(mode),
          pair_(pair),
          across_(*pair.across),
          kind_(kindOf(mode)),
          baseline_(pair.baseline.channels.at(mode.number)),
          test_(pair.test.channels.at(mode.number)),
          error_(mode.metric, mode.kind, baseline_, pair.coverage),
          place_(mode, pair, baseline_, test_),
          facet_(pair),
          bits_(kind_ == Kind::surface ? 2 * encodingBound(mode, pair) : 0),
          texels_(imageOf(across_.texels, mode.number)),
          expected_(imageOf(across_.relit, mode.number)),
          shadowed_(pair) {
        if (mode.number == static_cast<int>(gpu::DEBUG_lit) && !pair.baseline.unblended.empty() &&
            !pair.test.unblended.empty())
            unblended_ = {&pair.baseline.unblended, &pair.test.unblended};
        if (!texels_ || !isColor()) return;
        shares_ = decodeShares(across_);
        for (std::size_t code = 0; code < 256; ++code) exact_[code] = exactSrgb(code);
    }

    // In the channel's metric.
    double operator()(std::size_t i) const {
        const double size = std::max(metrics::largestFinite(baseline_.pixel(i), mode_.width), error_.floor());
        const double unit = mode_.metric == Metric::relative ? size : 1;
        const double rounding = relativeRounding() * (mode_.domain == Domain::unit ? degreesPerRadian : size);
        switch (kind_) {
            case Kind::id:
                return 0;
            case Kind::step:
                return isBeside(i) ? 1 : 0;
            case Kind::facet:
                return facet_(i);
            case Kind::place:
                return (place_(i) + rounding) / unit;
            case Kind::surface:
                return (place_(i) + rounding + textures(i)) / unit + bits_;
            case Kind::light:
                return 2 * shadingRounding + shadowed_.relative(i);
            case Kind::seen:
                return 2 * shadingRounding;
            case Kind::list:
                return std::numeric_limits<double>::infinity();
        }
        return 0;
    }

    // The difference that is held to it.
    double error(std::size_t i) const {
        if (kind_ != Kind::light) return error_(test_.pixel(i), baseline_.pixel(i));
        const Image &lit = unblended_[1] ? *unblended_[1] : test_,
                    &expected = expected_ ? *expected_ : baseline_;
        const double apart =
            std::max(metrics::distance(lit.pixel(i), expected.pixel(i), mode_.width), blendedApart(i));
        return apart == 0 ? 0
                          : apart / std::max(metrics::largestFinite(baseline_.pixel(i), mode_.width),
                                             error_.floor());
    }

    // How much further apart lit is than before something was blended over it, beyond what it changes by to
    // the next pixels: edges and textures of what is blended are in no channel.
    double blendedApart(std::size_t i) const {
        if (!unblended_[0] || !unblended_[1]) return 0;
        double beside = metrics::distance(unblended_[0]->pixel(i), unblended_[1]->pixel(i), mode_.width);
        for (const Image* image : {&baseline_, &test_})
            aroundPixel(*image, i, [&](std::size_t j, unsigned) {
                beside = std::max(beside, metrics::distance(image->pixel(i), image->pixel(j), mode_.width));
            });
        return std::max(0.0, metrics::distance(baseline_.pixel(i), test_.pixel(i), mode_.width) - beside);
    }

    std::string because() const {
        const auto& [a, b] = across_.devices;
        const std::string placed = fmt::format(
            "vertices are placed to 1/{} and 1/{} of a pixel, so much of what changes to the next one",
            1u << a.sub_pixel_bits, 1u << b.sub_pixel_bits);
        switch (kind_) {
            case Kind::id:
                return "an index is carried whole";
            case Kind::step:
                return "an index, which may be its neighbour's where it changes";
            case Kind::facet:
                return "a triangle's normal, from places that are rounded to 2^-24 of their distance, and "
                       "packed";
            case Kind::place:
                return placed + fmt::format("; and {:.2g} of it by rounding", relativeRounding());
            case Kind::surface: {
                std::string words = placed;
                if (texels_)
                    words +=
                        "; filters mix texels of two levels with weights of " +
                        fmt::format("{} and {} bits", a.sub_texel_bits, b.sub_texel_bits) +
                        ", and Vulkan leaves open the level of detail, so that either may be any mean of "
                        "the texels that it may see" +
                        decoding();
                if (bits_ > 0) words += fmt::format("; and both G-buffers' bits, {:.3g}", bits_);
                return words;
            }
            case Kind::light:
                return fmt::format(
                    "what {} makes of the surfaces that {} drew, both in float32: 1e-4 each, before anything "
                    "is blended; and "
                    "blended, no further apart than the next pixels",
                    a.name, b.name);
            case Kind::seen:
                return "float32 weights, 1e-4 each; at a shadow's edge texels of the map may show another "
                       "triangle";
            case Kind::list:
                return "each device's lists have cells of the size that costs it least; what they leave out "
                       "shows "
                       "in lit";
        }
        return {};
    }

private:
    // Whether what one picture shows at a pixel is beside it in either.
    bool isBeside(std::size_t i) const {
        bool found = false;
        for (const Image* image : {&baseline_, &test_})
            aroundPixel(*image, i, [&](std::size_t j, unsigned) {
                found = found ||
                        (*image->pixel(j) == *test_.pixel(i) && *image->pixel(j) != *baseline_.pixel(i)) ||
                        (*image->pixel(j) == *baseline_.pixel(i) && *image->pixel(j) != *test_.pixel(i));
            });
        return found;
    }

    bool isColor() const {
        switch (static_cast<gpu::uint>(mode_.number)) {
            case gpu::DEBUG_albedo:
            case gpu::DEBUG_dielectric_f0:
            case gpu::DEBUG_specular:
            case gpu::DEBUG_emission:
            case gpu::DEBUG_lightmap:
                return true;
            default:
                return false;
        }
    }

    static const Image* imageOf(const std::map<int, Image>& images, int mode) {
        const auto found = images.find(mode);
        return found == images.end() ? nullptr : &found->second;
    }

    // What the devices' decoding and filtering of textures may change, in the channel's unit.
    double textures(std::size_t i) const {
        if (!texels_) return 0;
        double most = *texels_->pixel(i);
        if (isColor()) {
            const bool radiance = mode_.metric == Metric::relative;
            for (int c = 0; c < mode_.width; ++c) {
                const double value = std::abs(double{baseline_.pixel(i)[c]});
                std::size_t code = radiance ? 1 : 0;  // which a factor may have brightened
                while (!radiance && code < 254 && exact_[code + 1] <= value) ++code;
                most = std::max(most, *texels_->pixel(i) + value * shares_[code]);
            }
            most += filterRounding(across_, true);
        }
        // Of linear texels; F0 is mixed by them.
        if (!isColor() || mode_.number == static_cast<int>(gpu::DEBUG_specular) ||
            mode_.number == static_cast<int>(gpu::DEBUG_dielectric_f0))
            most +=
                filterRounding(across_, false) *
                (mode_.number == static_cast<int>(gpu::DEBUG_normals) ? 2 * std::sqrt(3.0) * degreesPerRadian
                 : mode_.number == static_cast<int>(gpu::DEBUG_tangent_normal) ? 2 * std::sqrt(3.0)
                                                                               : 1);
        return most;
    }
    std::string decoding() const {
        if (!isColor())
            return "; their filters round by up to " +
                   fmt::format("{:.2g} of a code", 255 * filterRounding(across_, false));
        return fmt::format("; they decode sRGB up to {:.2g} % apart", 100 * shares_[1]);
    }

    const DebugMode& mode_;
    const FramePair& pair_;
    const AcrossDevices& across_;
    Kind kind_;
    const Image &baseline_, &test_;
    PixelError error_;
    PlaceBound place_;
    FacetBound facet_;
    double bits_;
    const Image *texels_, *expected_;
    Shadowed shadowed_;
    std::array<const Image*, 2> unblended_{};     // of lit, where something may be blended
    std::array<double, 256> shares_{}, exact_{};  // decodeShares(), exactSrgb()
};

}  // namespace

SurfaceGrid::SurfaceGrid(const FramePair& pair)
    : surface(pair.coverage.covered.size()),
      material(surface.size()),
      narrow(surface.size()),
      steeper(surface.size(), 1.0f) {
    const Image* const ids = findChannel(pair.baseline, gpu::DEBUG_material_id);
    if (!ids) return;
    const std::array sides{SurfaceAround(pair.baseline), SurfaceAround(pair.test)};
    const FacetBound facetOf(pair);
    const Steepness steepness(pair.baseline);
    const Image* const depth = findChannel(pair.baseline, gpu::DEBUG_depth);
    const double step = stepOf(*pair.across, &DevicePrecision::sub_pixel_bits);
    tbb::parallel_for(std::size_t{0}, surface.size(), [&](std::size_t i) {
        if (!pair.coverage.covered[i]) return;
        const double facet = facetOf(i);
        unsigned same = 0, alike = 0, triangle = 0;
        double shown = 0;
        aroundPixel(*ids, i, [&](std::size_t j, unsigned bit) {
            const auto both = [&](const auto& of) { return of(sides[0]) && of(sides[1]); };
            if (!both([&](const SurfaceAround& of) { return of.sameMaterial(i, j); })) return;
            alike |= bit;
            if (!both([&](const SurfaceAround& of) { return of.same(i, j); })) return;
            same |= bit;
            if (both([&](const SurfaceAround& of) { return of.turned(i, j) <= facet; })) triangle |= bit;
            if (depth) shown = std::max(shown, metrics::distance(*depth->pixel(i), *depth->pixel(j)));
        });
        surface[i] = static_cast<std::uint8_t>(same);
        material[i] = static_cast<std::uint8_t>(alike);
        narrow[i] = (triangle & across_bits) == 0 || (triangle & down_bits) == 0 ? 1 : 0;
        if (shown > 0) steeper[i] = static_cast<float>(std::max(1.0, steepness.slope(i, step) / shown));
    });
}

std::vector<int> surfacePixelChannels() {
    return {static_cast<int>(gpu::DEBUG_material_id), static_cast<int>(gpu::DEBUG_depth),
            static_cast<int>(gpu::DEBUG_position), static_cast<int>(gpu::DEBUG_geometric_normal)};
}

namespace {

// Counts pixels that differ, and tells where they must not.
void count(SurfacePixels::Differing& of, std::size_t i, int width, bool differs, bool edge) {
    of.edges += edge;
    of.count += differs;
    if (!differs || edge || of.strays++ > 0) return;
    of.x = static_cast<int>(i % static_cast<std::size_t>(width));
    of.y = static_cast<int>(i / static_cast<std::size_t>(width));
}

std::uint64_t mostOf(double share, std::uint64_t edges) {
    return std::max(fewPixels, static_cast<std::uint64_t>(std::min(1.0, share) * static_cast<double>(edges)));
}

}  // namespace

SurfacePixels surfacePixels(const FramePair& pair) {
    SurfacePixels found;
    found.others.assign(pair.coverage.covered.size(), 0);
    const auto both = [&](gpu::uint mode) {
        return std::array{findChannel(pair.baseline, mode), findChannel(pair.test, mode)};
    };
    const auto [a, b] = both(gpu::DEBUG_material_id);
    const auto [n, m] = both(gpu::DEBUG_geometric_normal);
    const auto [z, w] = both(gpu::DEBUG_depth);
    const auto [p, q] = both(gpu::DEBUG_position);
    const auto [u, v] = pair.across->texcoords;
    if (!a || !b) return found;
    const std::array sides{SurfaceAround(pair.baseline), SurfaceAround(pair.test)};
    const FacetBound facetOf(pair);
    std::optional<DeviceBounds> depth;
    if (z && w) depth.emplace(debugMode(gpu::DEBUG_depth), pair);
    std::optional<PlaceBound> coordinates;
    const DebugMode& texcoords = debugMode(gpu::DEBUG_texcoords);
    if (u && v) coordinates.emplace(texcoords, pair, *u, *v);
    const Shadowed shadowed(pair);
    std::optional<DeviceBounds> light;
    if (findChannel(pair.baseline, gpu::DEBUG_lit) && findChannel(pair.test, gpu::DEBUG_lit) &&
        pair.across->relit.contains(gpu::DEBUG_lit))
        light.emplace(debugMode(gpu::DEBUG_lit), pair);
    const double step = stepOf(*pair.across, &DevicePrecision::sub_pixel_bits);
    // How far from a place the other surface of its depth may lie, m.
    const auto tieReach = [&](std::size_t i) {
        return *z->pixel(i) * (step / pixelsPerRadian(pair.baseline, i) + relativeRounding());
    };
    for (std::size_t i = 0; i < found.others.size(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const double facet = facetOf(i);
        const bool edge = isBesideEdge(sides[0], *a, n, i, facet) ||
                          isBesideEdge(sides[1], *b, m, i, facet) ||
                          (coordinates && (isBesideSeam(*u, i) || isBesideSeam(*v, i)));
        const bool material = *a->pixel(i) != *b->pixel(i),
                   place = (n && m && metrics::angle(n->pixel(i), m->pixel(i)) > facet) ||
                           (depth && !(depth->error(i) <= (*depth)(i))),
                   seam = coordinates &&
                          !(apart(texcoords, u->pixel(i), v->pixel(i)) <=
                            (*coordinates)(i) +
                                relativeRounding() * std::max(1.0, metrics::largestFinite(u->pixel(i), 2)));
        const bool other = material || place || seam;
        if (other && !place && p && q && z && pair.across->surface_at) {
            const double near =
                *z->pixel(i) * (step / pixelsPerRadian(pair.baseline, i) + relativeRounding());
            const auto isThere = [&](const Image& ids, const Image& places) {
                return *ids.pixel(i) >= 0 && pair.across->surface_at(static_cast<int>(*ids.pixel(i)),
                                                                     places.pixel(i), near, !material);
            };
            if (isThere(*a, *p) && isThere(*b, *q)) {
                found.others[i] = 1;
                ++found.tied;
                continue;
            }
        }
        if (!other && light && p && z && pair.across->surface_at && light->blendedApart(i) > 0 &&
            pair.across->surface_at(-1, p->pixel(i), tieReach(i), false)) {
            found.others[i] = 1;
            ++found.tied;
            continue;
        }
        count(found.triangles, i, a->width, other, edge);
        // Light that is further apart beside a shadow's edge lies in another shadow, too, at the other's
        // place.
        const bool beside = shadowed.isBesideEdge(i),
                   shade = !other &&
                           (shadowed.differs(i) || (beside && light && !(light->error(i) <= (*light)(i))));
        count(found.shadows, i, a->width, shade, beside);
        found.others[i] = other || shade ? 1 : 0;
    }
    found.triangles.most = mostOf(edgesOfPixel * step, found.triangles.edges);
    // Each of a filter's texels across an edge may show another triangle.
    const double texels = pair.baseline.settings.shadow_kernel + 1;
    found.shadows.most = mostOf(edgesOfPixel * step * texels, found.shadows.edges);
    return found;
}

std::string SurfacePixels::fault() const {
    for (const auto& [of, shows, edge] : {std::tuple{&triangles, "show another triangle", "an edge"},
                                          {&shadows, "lie in another shadow", "the edge of a shadow"}}) {
        if (of->strays > 0)
            return fmt::format("{} pixel(s) {} on the other device and are not beside {}, the first at {},{}",
                               of->strays, shows, edge, of->x, of->y);
        if (of->count > of->most)
            return fmt::format("{} pixel(s) {} on the other device: of {} beside {} {} may", of->count, shows,
                               of->edges, edge, of->most);
    }
    return {};
}

std::string SurfacePixels::inWords() const {
    std::string words = fmt::format(
        "not compared: {} pixel(s) that show another triangle on the other device, all beside an edge ({} of "
        "{} may)",
        triangles.count, triangles.most, triangles.edges);
    if (shadows.edges > 0)
        words += fmt::format("; {} in another shadow, all beside a shadow's edge ({} of {} may)",
                             shadows.count, shadows.most, shadows.edges);
    if (tied > 0) words += fmt::format("; {} where the scene has two surfaces of one depth", tied);
    return words;
}

EncodingUse deviceUse(const DebugMode& mode, const FramePair& pair) {
    const DeviceBounds bounds(mode, pair);
    EncodingUse use;
    const Image& image = pair.baseline.channels.at(mode.number);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        if (!pair.coverage.covered[i]) continue;
        const double allowed = bounds(i), error = bounds.error(i);
        if (std::isfinite(allowed)) {
            use.most = std::max(use.most, allowed);
            use.mean += allowed;
        }
        if (error == 0) continue;
        const double used = error / allowed;
        use.beyond += !(used <= 1);
        if (!(used > use.used) && use.x >= 0) continue;
        use.used = used;
        use.x = static_cast<int>(i % static_cast<std::size_t>(image.width));
        use.y = static_cast<int>(i / static_cast<std::size_t>(image.width));
    }
    if (pair.coverage.count > 0) use.mean /= static_cast<double>(pair.coverage.count);
    return use;
}

Tolerance deviceTolerance(const DebugMode& mode, const FramePair& pair, const EncodingUse& use) {
    return {use.most, DeviceBounds(mode, pair).because()};
}

}  // namespace diptych
