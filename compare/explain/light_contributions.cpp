// SPDX-License-Identifier: MIT
#include "compare/explain/light_contributions.h"

#include "compare/explain/frame_images.h"
#include "shared/scene/lights/lights_json.h"
#include "shared/scene/lights/shadow_casters.h"
#include "shared/scene/model/luminance.h"

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace diptych {

namespace {

// Limits of lights rendered alone: their number, and the bytes of two images of each.
constexpr std::size_t maxLightsDrawn = 32, maxLightBytes = std::size_t{1} << 30;

// Settings of shadows and of the light from single lights.
bool isOfLights(std::string_view option) {
    return option.starts_with("shadow") || option.starts_with("evsm") || option.starts_with("clipmap") ||
           option == "light-cutoff" || option == "area-lights";
}

// "Lamp"; else the light's type.
std::string titleOf(const Light& light) {
    if (!light.name.empty()) return light.name;
    return light.kind == LightKind::rect ? "rectangle" : std::string(nameOf(light.kind));
}

// Each light's fraction of the sum of all lights' differences, at each pixel.
std::vector<std::vector<float>> fractionsOfDifference(const std::vector<Image>& a,
                                                      const std::vector<Image>& b) {
    std::vector<std::vector<float>> parts(a.size(), std::vector<float>(a.front().pixels()));
    std::vector<double> sums(parts.front().size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::vector<double> errors = errorsOf(a[i], b[i]);
        for (std::size_t p = 0; p < errors.size(); ++p) {
            parts[i][p] = static_cast<float>(errors[p]);
            sums[p] += errors[p];
        }
    }
    for (std::vector<float>& part : parts)
        for (std::size_t p = 0; p < part.size(); ++p)
            if (sums[p] > 0) part[p] = static_cast<float>(double{part[p]} / sums[p]);
    return parts;
}

// The indices of the lights that a cause may change, the brightest first. `of`: name of the cause. For shadow
// channels only suns, or only other lights; of these the shadow-casting ones, if there are any.
std::vector<std::size_t> lightsOf(std::string_view of, const std::vector<Light>& lights, int shadow_lights) {
    const bool suns = of == "shadow_visibility", locals = of == "local_visibility";
    const std::vector<std::size_t> casting = castingLights(lights, shadow_lights);
    const auto fits = [&](std::size_t index) {
        const bool is_sun = lights[index].kind == LightKind::directional;
        return suns ? is_sun : !locals || !is_sun;
    };
    const bool any_casts = std::ranges::any_of(casting, fits);
    std::vector<std::size_t> indices;
    for (std::size_t index = 0; index < lights.size(); ++index)
        if (fits(index) && (!(suns || locals) || !any_casts || std::ranges::count(casting, index) > 0))
            indices.push_back(index);
    std::ranges::stable_sort(indices, std::ranges::greater(), [&](std::size_t index) {
        return double{lights[index].intensity} * luminance(glm::dvec3(lights[index].color));
    });
    return indices;
}

constexpr int blockSide = 8;
constexpr std::size_t maxLightsOfBlock = 3;
constexpr double minAccount = 0.05, equalAccounts = 0.02;
constexpr double maxLeft = 0.1;

double sumOf(const glm::dvec3& c) {
    return c.x + c.y + c.z;
}

// One block: the remaining change, and each light's part of it.
class LightBlock {
public:
    LightBlock(const Image& change, std::span<const Image> terms, LightChange how, int x, int y)
        : terms_(terms), how_(how) {
        for (int v = y; v < std::min(y + blockSide, change.height); ++v)
            for (int u = x; u < std::min(x + blockSide, change.width); ++u) {
                pixels_.push_back(static_cast<std::size_t>(v) * static_cast<std::size_t>(change.width) +
                                  static_cast<std::size_t>(u));
                left_.push_back(colorAt(change, pixels_.back()));
            }
    }

    void divide(std::vector<std::vector<float>>& contributions) {
        const std::vector<glm::dvec3> change = left_;
        const double all = squares();
        std::vector<std::vector<double>> sizes = taken(all);
        if (how_ == LightChange::factor && squares() > maxLeft * all) {
            left_ = change;
            each_color_ = true;
            sizes = taken(all);
        }
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            double sum = 0;
            for (const std::vector<double>& light : sizes) sum += light[i];
            for (std::size_t light = 0; sum > 0 && light < sizes.size(); ++light)
                contributions[light][pixels_[i]] = static_cast<float>(sizes[light][i] / sum);
        }
    }

private:
    // The sum of squares of the remaining change.
    double squares() const {
        double sum = 0;
        for (const glm::dvec3& c : left_) sum += glm::dot(c, c);
        return sum;
    }

    // Subtracts lights as long as each accounts for enough. Returns each light's magnitude at each pixel.
    std::vector<std::vector<double>> taken(double all) {
        std::vector<std::vector<double>> sizes(terms_.size(), std::vector<double>(pixels_.size()));
        for (std::size_t count = 0; all > 0 && count < maxLightsOfBlock; ++count) {
            std::vector<double> accounts(terms_.size());
            for (std::size_t light = 0; light < terms_.size(); ++light) accounts[light] = account(light);
            const auto best = std::ranges::max_element(accounts);
            if (best == accounts.end() || !(*best >= minAccount * all)) break;
            std::vector<std::size_t> alike;
            for (std::size_t light = 0; light < accounts.size(); ++light)
                if (accounts[light] >= (1 - equalAccounts) * *best) alike.push_back(light);
            take(static_cast<std::size_t>(best - accounts.begin()), alike, sizes);
        }
        return sizes;
    }

    // For each pixel, the factor of the light's term that best explains the remaining change (least squares).
    // LightChange::factor: the same at all pixels, for all colours or each; visibility: by pixel, -1 to 1;
    // whole: 1 or -1 where that reduces the change, else 0.
    std::vector<glm::dvec3> factors(std::size_t light) const {
        glm::dvec3 along(0), size(0);
        std::vector<glm::dvec3> of(pixels_.size(), glm::dvec3(0));
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const glm::dvec3 term = colorAt(terms_[light], pixels_[i]);
            along += left_[i] * term;
            size += term * term;
            const double s = glm::dot(term, term);
            if (how_ == LightChange::visibility && s > 0)
                of[i] = glm::dvec3(std::clamp(glm::dot(left_[i], term) / s, -1.0, 1.0));
        }
        if (how_ == LightChange::factor) {
            if (!each_color_) along = glm::dvec3(sumOf(along)), size = glm::dvec3(sumOf(size));
            glm::dvec3 factor(0);
            for (int c = 0; c < 3; ++c)
                if (size[c] > 0) factor[c] = along[c] / size[c];
            std::ranges::fill(of, factor);
        }
        const glm::dvec3 sign(std::copysign(1.0, sumOf(along)));
        if (how_ == LightChange::whole)
            // A light present on both sides changes nothing.
            for (std::size_t i = 0; i < pixels_.size(); ++i)
                if (reduction(light, i, sign) > 0) of[i] = sign;
        return of;
    }

    // The decrease of the squared change at a pixel by subtracting that part.
    double reduction(std::size_t light, std::size_t i, const glm::dvec3& factor) const {
        const glm::dvec3 of = factor * colorAt(terms_[light], pixels_[i]);
        return 2 * glm::dot(left_[i], of) - glm::dot(of, of);
    }

    double account(std::size_t light) const {
        const std::vector<glm::dvec3> of = factors(light);
        double sum = 0;
        for (std::size_t i = 0; i < of.size(); ++i) sum += reduction(light, i, of[i]);
        return sum;
    }

    void take(std::size_t best, const std::vector<std::size_t>& alike,
              std::vector<std::vector<double>>& sizes) {
        const std::vector<glm::dvec3> of = factors(best);
        for (std::size_t i = 0; i < pixels_.size(); ++i) {
            const glm::dvec3 taken = of[i] * colorAt(terms_[best], pixels_[i]);
            const auto size = [&](std::size_t light) {
                return glm::length(colorAt(terms_[light], pixels_[i]));
            };
            double sum = 0;
            for (const std::size_t light : alike) sum += size(light);
            for (const std::size_t light : alike)
                if (sum > 0) sizes[light][i] += glm::length(taken) * size(light) / sum;
            left_[i] -= taken;
        }
    }

    std::span<const Image> terms_;
    LightChange how_;
    bool each_color_ = false;  // one factor per colour
    std::vector<std::size_t> pixels_;
    std::vector<glm::dvec3> left_;
};

}  // namespace

std::vector<CausePart> lightParts(const AblationCause& cause, const std::vector<double>& map,
                                  const Ablation& ablation, Explanation& found) {
    const LightingComponents::Component* const component = ablation.componentOf(cause);
    if (component ? !component->lights
                  : cause.kind != AblationCause::Kind::setting || !isOfLights(cause.name))
        return {};
    const Settings &baseline = ablation.sides().settings(0), &test = ablation.sides().settings(1);
    const std::vector<Light> lights = ablation.lighting().under(test).lights();
    std::vector<std::size_t> indices =
        lightsOf(cause.name, lights, std::max(baseline.shadow_lights, test.shadow_lights));
    if (indices.empty()) return {};
    const std::size_t room = maxLightBytes / (2 * 3 * sizeof(float) * map.size()), all = indices.size();
    indices.resize(std::min(all, std::clamp<std::size_t>(room, 1, maxLightsDrawn)));
    found.lights_drawn = std::max(found.lights_drawn, indices.size());
    found.lights_omitted = std::max(found.lights_omitted, all - indices.size());
    // Each light's own contribution under some Settings.
    const auto alone = [&](const Settings& settings) {
        ChannelShading& shading = ablation.lighting().under(settings);
        std::vector<Image> images;
        for (const std::size_t index : indices) {
            const LightChannels adds = shading.light(allChannelsOf(1), index);
            images.push_back(component ? LightingComponents::directLight(*component, adds)
                                       : sumOfLobes(adds));
        }
        return images;
    };
    std::vector<std::vector<float>> parts;
    Settings settings = test;
    if (component) {
        if (*component->lights == LightChange::visibility) settings.shadows = Shadows::off;
        parts = lightsOfChange(
            LightingComponents::directLight(*component, LightingComponents::change(*component)),
            alone(settings), *component->lights);
    } else {
        settings.set(cause.name, baseline.valueOf(cause.name));
        const std::vector<Image> ablated = alone(settings);
        // Last, so that the next cause can use its frame.
        parts = fractionsOfDifference(alone(test), ablated);
    }
    std::vector<CausePart> contributions;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        double sum = 0;
        for (std::size_t p = 0; p < map.size(); ++p) sum += map[p] * double{parts[i][p]};
        if (sum != 0)
            contributions.push_back({static_cast<int>(indices[i]), titleOf(lights[indices[i]]),
                                     sum / static_cast<double>(map.size())});
    }
    return contributions;
}

std::vector<std::vector<float>> lightsOfChange(const Image& change, std::span<const Image> terms,
                                               LightChange how) {
    std::vector<std::vector<float>> contributions(terms.size(), std::vector<float>(change.pixels()));
    const int columns = (change.width + blockSide - 1) / blockSide,
              rows = (change.height + blockSide - 1) / blockSide;
    tbb::parallel_for(0, columns * rows, [&](int block) {
        LightBlock(change, terms, how, block % columns * blockSide, block / columns * blockSide)
            .divide(contributions);
    });
    return contributions;
}

}  // namespace diptych
