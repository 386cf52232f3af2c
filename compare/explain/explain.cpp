// SPDX-License-Identifier: MIT
#include "compare/explain/explain.h"

#include "compare/explain/ablation.h"
#include "compare/explain/channel_lighting.h"
#include "compare/explain/explained_sides.h"
#include "compare/explain/frame_images.h"
#include "compare/explain/light_contributions.h"
#include "compare/explain/shapley.h"
#include "compare/explain/undeclared_settings.h"
#include "compare/frames/frame_properties.h"
#include "compare/metrics/flip.h"
#include "compare/metrics/pixel.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>

namespace diptych {

namespace {

// Beyond maxExactCauses; each evaluates as many subsets as there are causes.
constexpr int sampledOrderCount = 40;
constexpr double namedPair = 0.05;

// Throws if two Frames have different views or lack a channel.
void checkExplained(const Frame& baseline, const Frame& test) {
    const Image& lit = channelOf(baseline, Channel::lit);
    channelOf(test, Channel::lit);
    for (const Frame* const frame : {&baseline, &test})
        for (const Channel channel : explainedChannels()) {
            if (layerOf(channel) != 0 && !frame->channels.contains(channel)) continue;
            const Image& image = channelOf(*frame, channel);
            if (image.width != lit.width || image.height != lit.height)
                throw std::runtime_error(fmt::format(
                    "{}: {} is {}x{}, but lit of {} is {}x{}; an explanation needs images of the same size",
                    frame->name, debugMode(channel).name, image.width, image.height, baseline.name, lit.width,
                    lit.height));
        }
    for (const std::string_view option :
         {"camera", "time", "animation", "variant", "env", "scene-lights", "lights", "seed"})
        if (baseline.settings.valueOf(option) != test.settings.valueOf(option))
            throw std::runtime_error(
                fmt::format("--{} {} and {}: an explanation needs two images of the same view and scene",
                            option, baseline.settings.valueOf(option), test.settings.valueOf(option)));
}

// The number of pixels where either image is not finite.
std::size_t nonfinitePixels(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (std::size_t p = 0; p < a.pixels(); ++p)
        count += !metrics::finite(a.pixel(p), 3) || !metrics::finite(b.pixel(p), 3);
    return count;
}

// An image with one value per pixel, of the size of `like`.
Image imageOf(const std::vector<double>& values, const Image& like) {
    Image image(like.width, like.height, 1);
    std::ranges::transform(values, image.data.begin(),
                           [](double value) { return static_cast<float>(value); });
    return image;
}

// Each material's part of a cause's contribution, by channel material_id. `map`: the cause's.
std::vector<CausePart> byMaterial(const std::vector<double>& map, const Image& ids, const Scene& scene) {
    std::map<int, double> sums;
    for (std::size_t p = 0; p < map.size(); ++p)
        sums[materialOf(ids.pixel(p), scene)] += map[p] / static_cast<double>(map.size());
    std::vector<CausePart> contributions;
    for (const auto& [id, sum] : sums)
        contributions.push_back(
            {id, id >= 0 ? scene.materials[static_cast<std::size_t>(id)].name : std::string(), sum});
    return contributions;
}

// Sorts parts, the largest in the sign of the cause's contribution first.
std::vector<CausePart> descending(std::vector<CausePart> parts, double sign) {
    std::ranges::stable_sort(parts, std::ranges::greater(),
                             [sign](const CausePart& part) { return sign * part.contribution; });
    return parts;
}

// The results of taking the causes.
struct AblationResults {
    Contributions contributions;
    std::vector<std::vector<double>> maps;  // of each cause, as Cause::map: one value per pixel
    std::vector<double> flip;               // of each cause, as Cause::flip
};

// Takes every subset of the causes, or those of sampled orders. `lit`: the baseline's. Stores the
// unexplained remainder and FLIP in `found`.
AblationResults ablate(Ablation& ablation, const Image& lit, const Stage& progress, Explanation& found) {
    const int count = static_cast<int>(ablation.causes().size());
    const bool exact = count <= maxExactCauses;
    const std::vector<SubsetWeights> subsets =
        exact ? exactWeights(count) : sampledWeights(count, sampledOrderCount, 1);
    AblationResults results;
    results.maps.assign(ablation.causes().size(), std::vector<double>(lit.pixels()));
    results.flip.resize(ablation.causes().size());
    std::map<Subset, double> values;
    const Subset all = (Subset{1} << count) - 1;
    for (std::size_t s = 0; s < subsets.size(); ++s) {
        progress.at(static_cast<double>(s) / static_cast<double>(subsets.size()), "swap causes");
        const Subset subset = subsets[s].subset;
        const std::vector<double>& weights = subsets[s].weight;
        const Image ablated = ablation.lit(subset);
        const std::vector<double> errors = errorsOf(ablated, lit);
        const double error = meanOf(errors), flip = hdrFlip(lit, ablated).mean;
        values[subset] = -error;
        if (subset == 0) found.flip = flip;
        if (subset == all) {
            found.unexplained = error;
            found.unexplained_map = imageOf(errors, lit);
            found.flip_unexplained = flip;
        }
        for (std::size_t i = 0; i < results.flip.size(); ++i) results.flip[i] -= weights[i] * flip;
        tbb::parallel_for(std::size_t{0}, results.maps.size(), [&](std::size_t i) {
            const double weight = weights[i];
            for (std::size_t p = 0; p < errors.size(); ++p) results.maps[i][p] -= weight * errors[p];
        });
    }
    const SubsetValue value = [&](Subset subset) { return values.at(subset); };
    results.contributions =
        exact ? exactContributions(count, value) : sampledContributions(count, value, sampledOrderCount, 1);
    return results;
}

// Pairs of causes that interact. `order`: the causes with an effect, descending by contribution.
std::vector<CausePair> pairsOf(const Contributions& contributions, const std::vector<std::size_t>& order,
                               double distance) {
    std::vector<CausePair> pairs;
    if (contributions.interaction.empty()) return pairs;
    const auto rankOf = [&](std::size_t cause) {
        return static_cast<std::size_t>(std::ranges::find(order, cause) - order.begin());
    };
    for (std::size_t j = 1; j < contributions.contribution.size(); ++j)
        for (std::size_t i = 0; i < j; ++i) {
            const double both = contributions.interaction[i + j * (j - 1) / 2];
            const std::size_t a = rankOf(i), b = rankOf(j);
            if (std::max(a, b) < order.size() && std::abs(both) > namedPair * distance)
                pairs.push_back({std::min(a, b), std::max(a, b), both});
        }
    std::ranges::stable_sort(pairs, [](const CausePair& a, const CausePair& b) {
        return std::abs(a.interaction) > std::abs(b.interaction);
    });
    return pairs;
}

// Stores the causes, the dominant one at each pixel, and interacting pairs in `found`.
void rank(const AblationResults& results, const Ablation& ablation, const Scene& scene, Explanation& found) {
    const Contributions& contributions = results.contributions;
    std::vector<std::size_t> order(ablation.causes().size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater(),
                             [&](std::size_t i) { return contributions.contribution[i]; });
    // Removes Settings without effect.
    std::erase_if(order, [&](std::size_t i) {
        const bool has_effect =
            contributions.contribution[i] != 0 || contributions.alone[i] != 0 || contributions.last[i] != 0;
        if (!has_effect) found.without_effect.push_back(ablation.causes()[i].title());
        return !has_effect;
    });
    const Image& ids = channelOf(ablation.sides().frame(0), Channel::material_id);
    for (const std::size_t i : order) {
        const AblationCause& cause = ablation.causes()[i];
        const std::vector<double>& map = results.maps[i];
        // For a negative contribution, the pixel where it is most negative.
        const double sign = contributions.contribution[i] < 0 ? -1 : 1;
        const auto worst = static_cast<int>(
            std::ranges::max_element(map, {}, [sign](double at) { return sign * at; }) - map.begin());
        found.causes.push_back({.name = cause.title(),
                                .description = cause.description,
                                .contribution = contributions.contribution[i],
                                .interval = contributions.interval[i],
                                .alone = contributions.alone[i],
                                .last = contributions.last[i],
                                .worst = map[static_cast<std::size_t>(worst)],
                                .worst_x = worst % ids.width,
                                .worst_y = worst / ids.width,
                                .flip = results.flip[i],
                                .materials = descending(byMaterial(map, ids, scene), sign),
                                .lights = descending(lightParts(cause, map, ablation, found), sign),
                                .map = imageOf(map, ids)});
    }
    for (std::size_t p = 0; p < found.dominant.pixels(); ++p) {
        double best = 0;
        for (std::size_t k = 0; k < order.size(); ++k)
            if (const double at = results.maps[order[k]][p]; at > best) {
                best = at;
                found.dominant.data[p] = static_cast<float>(k);
            }
    }
    const auto& dominant_causes = found.dominant.data;
    const auto with_cause = std::ranges::count_if(dominant_causes, [](float cause) { return cause >= 0; });
    for (std::size_t k = 0; with_cause > 0 && k < order.size(); ++k)
        found.causes[k].dominates =
            static_cast<double>(std::ranges::count(dominant_causes, static_cast<float>(k))) /
            static_cast<double>(with_cause);
    found.pairs = pairsOf(contributions, order, found.distance);
}

}  // namespace

std::vector<Channel> explainedChannels() {
    std::vector<Channel> modes(surfaceChannels().begin(), surfaceChannels().end());
    modes.push_back(Channel::lit);
    modes.push_back(Channel::material_id);
    modes.push_back(Channel::lightmapped);  // beside lightmap
    std::ranges::sort(modes);
    return modes;
}

Explanation explain(Device& device, Renderer& renderer, const Scene& scene, const Frame& baseline,
                    const Frame& test, const Stage& progress) {
    checkExplained(baseline, test);
    const Image &a = channelOf(baseline, Channel::lit), &b = channelOf(test, Channel::lit);
    const std::vector<double> errors = errorsOf(b, a);
    Explanation found;
    found.distance = meanOf(errors);
    found.nonfinite = nonfinitePixels(a, b);
    found.dominant = Image(a.width, a.height, 1, -1.0f);
    found.unexplained_map = imageOf(errors, a);
    ChannelLighting lighting(device, renderer, baseline, test);
    ExplainedSides sides(baseline, test, lighting);
    found.reproduction = {sides.reproduction(0), sides.reproduction(1)};
    if (found.distance > 0) {
        sides.findExposure();
        const std::vector<UndeclaredSetting> undeclared = undeclaredSettings(sides, lighting);
        if (!undeclared.empty()) sides.believe(undeclared.back().settings, lighting);
        Ablation ablation(sides, lighting, scene, undeclared);
        found.without_effect = ablation.without_effect();
        rank(ablate(ablation, a, progress, found), ablation, scene, found);
    }
    found.subsets = lighting.shaded();
    found.frames = lighting.drawn();
    return found;
}

}  // namespace diptych
