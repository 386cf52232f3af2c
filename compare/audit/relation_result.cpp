// SPDX-License-Identifier: MIT
#include "compare/audit/relate.h"

#include "compare/metrics/channel.h"
#include "compare/verdict/neighbours.h"
#include "shared/contract/constants.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace diptych::audit {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double minAlpha = 1e-4;  // below it a highlight is smaller than any pixel
// Largest relative change per radian of a thin film's colours, two terms cos(2.24e6 p) exp(-4.5e9 p^2) with p
// = 2 pi OPD: as p changes by its own size at most, each changes by at most 14.
constexpr double filmSlope = 30;

// Covered edge pixels for each pixel that may be excluded. A step of a vertex moves an edge by as much. Over
// the length of an edge that crosses a pixel, 2 steps of it change sides, for either of two edges. Twice
// that, because they do not fall evenly.
constexpr std::uint64_t edgesPerExcluded = 16;
constexpr std::uint64_t fewPixels = 8;  // chance decides about so few
// Surfaces of equal depth are modelling accidents.
constexpr std::uint64_t pixelsPerTie = 100;

double largest(const float* pixel, int components) {
    double max = 0;
    for (int c = 0; c < components; ++c)
        if (std::isfinite(pixel[c])) max = std::max(max, std::abs(double{pixel[c]}));
    return max;
}

// Over the components. Infinite if one value is not finite and the other is not the same.
double largestDifference(const float* a, const float* b, int components) {
    double max = 0;
    for (int c = 0; c < components; ++c) {
        if (a[c] == b[c] || (std::isnan(a[c]) && std::isnan(b[c]))) continue;
        const double difference = std::abs(double{a[c]} - double{b[c]});
        max = std::max(max, std::isfinite(difference) ? difference : unbounded);
    }
    return max;
}

// Fraction of the tolerance used; a non-finite error exceeds any tolerance, even an infinite one.
double ratioOf(double error, double allowed) {
    if (error == 0) return 0;
    return allowed > 0 && error < unbounded ? error / allowed : unbounded;
}

// In ulps of the largest component.
double ulpDifference(const float* a, const float* b, int components) {
    const double difference = largestDifference(a, b, components);
    if (difference == 0 || difference == unbounded) return difference;
    const auto top = static_cast<float>(std::max(largest(a, components), largest(b, components)));
    return difference / (double{std::nextafter(top, std::numeric_limits<float>::infinity())} - double{top});
}

// Calls visit(index) for the pixels around one.
template <class Visit>
void aroundPixel(const Image& image, std::size_t pixel, const Visit& visit) {
    within(image, pixel, 1, [&](std::size_t i, int, int) {
        if (i != pixel) visit(i);
    });
}

class Evaluation {
public:
    Evaluation(const Frame& original, const Frame& changed, const RelationTolerance& tolerance)
        : original_(original),
          changed_(changed),
          tolerance_(tolerance),
          where_(coverage(original, changed)) {}

    FrameResult run() {
        FrameResult result;
        result.covered = where_.count;
        excluded_.assign(where_.covered.size(), false);
        filtered_.assign(where_.covered.size(), false);
        if (tolerance_.equality == Equality::rounding) excludeEdges(result);
        if (tolerance_.reorders) excludeTies(result);
        if (tolerance_.equality == Equality::rounding) findFiltered(result);
        double max = -1;
        for (const Channel mode : relatedChannels()) {
            if (!isKnown(mode)) continue;
            Image used;
            result.channels.push_back(channel(mode, used));
            const ChannelResult& of = result.channels.back();
            if (of.used > max && (max <= 1 || mode == Channel::lit)) {
                max = of.used;
                result.used_by_pixel = std::move(used);
            }
        }
        return result;
    }

private:
    const Image& original(Channel mode) const { return original_.channels.at(mode); }
    const Image& changed(Channel mode) const { return changed_.channels.at(mode); }

    // Scenes without a layer lack its channels.
    bool isKnown(Channel mode) const {
        return original_.channels.contains(mode) && changed_.channels.contains(mode);
    }

    double difference(Channel mode, std::size_t pixel) const {
        return largestDifference(original(mode).pixel(pixel), changed(mode).pixel(pixel),
                                 original(mode).components);
    }
    // The largest component in either image.
    double size(Channel mode, std::size_t pixel) const {
        const int components = original(mode).components;
        return std::max(largest(original(mode).pixel(pixel), components),
                        largest(changed(mode).pixel(pixel), components));
    }
    // A packed G-buffer may change both images by this.
    double packed(Channel mode) const {
        const auto bound = tolerance_.packed.find(mode);
        return bound == tolerance_.packed.end() ? 0 : 2 * bound->second;
    }

    // Largest change of a channel, in either image, to neighbouring pixels of the same material, or to all
    // if none has it.
    double variation(Channel mode, std::size_t pixel) const {
        double alike = 0, any = 0;
        bool found = false;
        for (const Frame* frame : {&original_, &changed_}) {
            const Image &image = frame->channels.at(mode), &ids = frame->channels.at(Channel::material_id);
            aroundPixel(image, pixel, [&](std::size_t other) {
                const double change =
                    largestDifference(image.pixel(pixel), image.pixel(other), image.components);
                if (change == unbounded) return;
                any = std::max(any, change);
                if (ids.data[pixel] != ids.data[other]) return;
                found = true;
                alike = std::max(alike, change);
            });
        }
        return found ? alike : any;
    }

    bool isTextured(std::size_t pixel) const {
        const float id = original(Channel::material_id).data[pixel];
        return id >= 0 && static_cast<std::size_t>(id) < tolerance_.textured.size() &&
               tolerance_.textured[static_cast<std::size_t>(id)];
    }

    // Difference of normals of a lobe, radians, beyond the packing error; normals are compared separately.
    double normalDifference(Channel mode, std::size_t pixel) const {
        return std::max(0.0, difference(mode, pixel) - packed(mode));
    }
    // Largest relative change of a lobe's light by the change of its normal. Per radian ln D of GGX changes
    // by 2 / alpha if the half vector is alpha away; cosines, Smith's and Fresnel's factors by some 4.
    double lightByNormal(Channel normals, Channel roughnesses, std::size_t pixel) const {
        const double roughness = original(roughnesses).data[pixel];
        return (2 / std::max(roughness * roughness, minAlpha) + 4) * normalDifference(normals, pixel);
    }
    // A sheen's ln D changes by cot(theta_h) / alpha, which is less than 2 / alpha where D is not small. The
    // sheen has a least roughness, and the normal of the base.
    double lightBySheen(std::size_t pixel) const {
        if (!isKnown(Channel::sheen_color) || !isKnown(Channel::sheen_roughness) ||
            largest(original(Channel::sheen_color).pixel(pixel), 3) == 0)
            return 0;
        const double roughness = std::max(double{original(Channel::sheen_roughness).data[pixel]},
                                          double{gpu::MIN_PERCEPTUAL_ROUGHNESS});
        return (2 / (roughness * roughness) + 4) * normalDifference(Channel::normals, pixel);
    }
    double lightByFilm(std::size_t pixel) const {
        return isKnown(Channel::iridescence) && original(Channel::iridescence).data[pixel] > 0
                   ? filmSlope * normalDifference(Channel::normals, pixel)
                   : 0;
    }
    double lightByNormals(std::size_t pixel) const {
        const bool coated = isKnown(Channel::clearcoat_normal) && isKnown(Channel::clearcoat_roughness);
        return lightByNormal(Channel::normals, Channel::roughness, pixel) +
               (coated ? lightByNormal(Channel::clearcoat_normal, Channel::clearcoat_roughness, pixel) : 0) +
               lightBySheen(pixel) + lightByFilm(pixel);
    }

    // Tolerance of `rounding` for the largest component, without steps of a texture filter.
    double allowedByRounding(Channel mode, std::size_t pixel) const {
        if (mode == Channel::material_id) return 0;
        const double value = size(mode, pixel);
        // A light's end cancels: the remainder has rounding errors relative to the whole.
        double allowed =
            tolerance_.relative * (mode == Channel::lit ? std::max(value, light_floor_) : value) +
            std::numeric_limits<float>::min();
        if (mode == Channel::geometric_normal) allowed += tolerance_.facet;
        if (tolerance_.step > 0) allowed += tolerance_.step * variation(mode, pixel);
        allowed += packed(mode) * (debugMode(mode).error_kind == ErrorKind::relative ? value : 1);
        if (mode == Channel::lit) allowed += value * lightByNormals(pixel);
        if (mode == Channel::lit && tolerance_.packed_light)
            allowed += double{tolerance_.packed_light->data[pixel]};
        return allowed;
    }
    bool isWithinRounding(Channel mode, std::size_t pixel) const {
        return difference(mode, pixel) <= allowedByRounding(mode, pixel);
    }

    // For a textured surface, whose light follows its channels: without the change to the next pixel.
    bool isFilteredAlike(Channel mode, std::size_t pixel) const {
        return difference(mode, pixel) <=
               std::max(1.0, size(mode, pixel)) * (tolerance_.relative + packed(mode));
    }

    // Whether another surface is visible beside the pixel: another material, another triangle's normal, or
    // a step in depth.
    static bool isBesideEdge(const Frame& frame, std::size_t pixel) {
        const Image &ids = frame.channels.at(Channel::material_id),
                    &depth = frame.channels.at(Channel::depth),
                    &facets = frame.channels.at(Channel::geometric_normal);
        bool found = false;
        aroundPixel(ids, pixel, [&](std::size_t other) {
            const double far = std::max(depth.data[pixel], depth.data[other]);
            found = found || ids.data[pixel] != ids.data[other] ||
                    largestDifference(facets.pixel(pixel), facets.pixel(other), 3) > 1e-3 ||
                    std::abs(double{depth.data[pixel]} - double{depth.data[other]}) > 0.01 * far;
        });
        return found;
    }

    void excludeEdges(FrameResult& result) {
        std::uint64_t edges = 0;
        for (std::size_t i = 0; i < excluded_.size(); ++i) {
            const bool beside = isBesideEdge(original_, i),
                       blended = tolerance_.blended && isNearBlended(*tolerance_.blended, i, 1);
            edges += beside || blended;
            excluded_[i] =
                (beside &&
                 (original(Channel::material_id).data[i] != changed(Channel::material_id).data[i] ||
                  !isWithinRounding(Channel::depth, i) || !isWithinRounding(Channel::geometric_normal, i))) ||
                (blended && !isWithinRounding(Channel::lit, i));
            result.excluded += excluded_[i];
        }
        result.max_excluded = std::max(fewPixels, edges / edgesPerExcluded);
    }

    void excludeTies(FrameResult& result) {
        for (std::size_t i = 0; i < excluded_.size(); ++i) {
            if (original(Channel::depth).data[i] != changed(Channel::depth).data[i]) continue;
            excluded_[i] = std::ranges::any_of(relatedChannels(), [&](Channel mode) {
                return mode != Channel::lit && isKnown(mode) && difference(mode, i) > 0;
            });
            result.excluded += excluded_[i];
        }
        result.max_excluded = std::max(fewPixels, where_.count / pixelsPerTie);
    }

    void findFiltered(FrameResult& result) {
        std::uint64_t textured = 0;
        for (std::size_t i = 0; i < excluded_.size(); ++i) {
            if (!where_.covered[i] || excluded_[i] || !isTextured(i)) continue;
            ++textured;
            filtered_[i] = std::ranges::any_of(relatedChannels(), [&](Channel mode) {
                return mode != Channel::lit && mode != Channel::material_id && mode != Channel::depth &&
                       mode != Channel::geometric_normal && isKnown(mode) && !isFilteredAlike(mode, i);
            });
            result.filtered += filtered_[i];
        }
        result.max_filtered = std::max(fewPixels, static_cast<std::uint64_t>(static_cast<double>(textured) *
                                                                             tolerance_.filtered_fraction));
    }

    double errorAt(Channel mode, std::size_t pixel, double& allowed) const {
        const float *const p = original(mode).pixel(pixel), *const q = changed(mode).pixel(pixel);
        const int components = original(mode).components;
        if (tolerance_.equality == Equality::bits ||
            (tolerance_.equality == Equality::sums && mode != Channel::lit)) {
            allowed = tolerance_.ulps;
            return ulpDifference(p, q, components);
        }
        if (tolerance_.equality == Equality::rounding) {
            const bool normal = mode == Channel::normals || mode == Channel::clearcoat_normal;
            allowed = allowedByRounding(mode, pixel);
            if (isTextured(pixel))
                allowed += tolerance_.filter_step * (normal ? 2 : 1) * std::max(1.0, size(mode, pixel));
            return difference(mode, pixel);
        }
        // Terms are at least 0, so each component's sum equals the sum of magnitudes.
        double worst = 0, error = 0;
        for (int c = 0; c < components; ++c) {
            const double may =
                tolerance_.relative * std::max(std::abs(double{p[c]}), std::abs(double{q[c]})) +
                std::numeric_limits<float>::min();
            const double is = largestDifference(p + c, q + c, 1);
            if (c > 0 && ratioOf(is, may) <= worst) continue;
            worst = ratioOf(is, may);
            error = is;
            allowed = may;
        }
        return error;
    }

    ChannelResult channel(Channel mode, Image& used) {
        const Image& image = original(mode);
        used = Image(image.width, image.height, 1);
        ChannelResult result{.mode = mode};
        for (std::size_t i = 0; i < excluded_.size(); ++i) {
            if (excluded_[i] || (filtered_[i] && mode == Channel::lit)) continue;
            double allowed = 0;
            const double error = errorAt(mode, i, allowed);
            if (error == 0) continue;
            const double ratio = ratioOf(error, allowed);
            used.data[i] = static_cast<float>(ratio);
            result.beyond += ratio > 1;
            if (ratio <= result.used && result.x >= 0) continue;
            result.used = ratio;
            result.error = error;
            result.allowed = allowed;
            result.x = static_cast<int>(i) % image.width;
            result.y = static_cast<int>(i) / image.width;
        }
        return result;
    }

    const Frame &original_, &changed_;
    const RelationTolerance& tolerance_;
    const Coverage where_;
    const double light_floor_ =
        PixelError(ErrorKind::relative, ChannelKind::color, original(Channel::lit), where_).floor();
    std::vector<bool> excluded_, filtered_;
};

void rotateBack(Image& image, const glm::dmat3& back) {
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        float* const v = image.pixel(i);
        const glm::dvec3 rotated = back * glm::dvec3(v[0], v[1], v[2]);
        for (int c = 0; c < 3; ++c) v[c] = static_cast<float>(rotated[c]);
    }
}

void divide(Image& image, double by) {
    for (float& value : image.data) value = static_cast<float>(value / by);
}

Image cut(const Image& image, const PixelMap& map) {
    Image part(image.width - 2 * map.border, image.height - 2 * map.border, image.components);
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x) {
            const int from = map.border + (map.mirrored ? part.width - 1 - x : x);
            for (int c = 0; c < part.components; ++c) part.at(x, y, c) = image.at(from, y + map.border, c);
        }
    return part;
}

}  // namespace

std::span<const Channel> relatedChannels() {
    static const std::vector<Channel> related = [] {
        std::vector<Channel> modes;
        for (const DebugMode& mode : debugModes())
            if (mode.related != 0) modes.push_back(mode.channel);
        std::ranges::sort(modes, {}, [](Channel mode) { return debugMode(mode).related; });
        return modes;
    }();
    return related;
}

std::string RelationTolerance::describe() const {
    if (equality == Equality::bits)
        return ulps == 0 ? "bit for bit" : fmt::format("{} ULP of the largest component", ulps);
    if (equality == Equality::sums) return fmt::format("lit: {:.2g} of each component", relative);
    return fmt::format("{:.2g} of the value{}", relative,
                       step > 0 ? fmt::format(" plus {:.2g} of its change to the next pixel", step) : "");
}

bool FrameResult::passes() const {
    return failed.empty() && excluded <= max_excluded && filtered <= max_filtered &&
           std::ranges::all_of(channels, [](const ChannelResult& of) { return of.beyond == 0; });
}

const ChannelResult* FrameResult::worst() const {
    const auto found = std::ranges::max_element(channels, {}, &ChannelResult::used);
    return found == channels.end() || found->x < 0 ? nullptr : &*found;
}

Frame mappedBack(const Frame& changed, const PixelMap& map) {
    Frame back;
    back.settings = changed.settings;
    back.settings.size.width -= 2 * map.border;
    back.settings.size.height -= 2 * map.border;
    back.background = changed.background;
    for (const Channel mode : relatedChannels()) {
        const Image* const its = findChannel(changed, mode);
        if (!its) continue;
        Image image = cut(*its, map);
        if (mode == Channel::lit || mode == Channel::emission) divide(image, map.light);
        if (mode == Channel::depth) divide(image, map.length);
        if (mode == Channel::normals || mode == Channel::geometric_normal ||
            mode == Channel::clearcoat_normal)
            if (map.rotation != glm::dmat3(1)) rotateBack(image, glm::transpose(map.rotation));
        if (mode == Channel::material_id && !map.ids.empty())
            for (float& id : image.data)
                if (id >= 0) id = static_cast<float>(map.ids.at(static_cast<std::size_t>(id)));
        back.channels.emplace(mode, std::move(image));
    }
    return back;
}

FrameResult evaluate(const Frame& original, const Frame& changed, const RelationTolerance& tolerance) {
    return Evaluation(original, changed, tolerance).run();
}

}  // namespace diptych::audit
