// SPDX-License-Identifier: MIT
#include "compare/explain/lighting_components.h"

#include "compare/explain/frame_images.h"
#include "shared/contract/debug_mode.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <utility>

namespace diptych {

namespace {

constexpr std::size_t diffuseTerm = 0, specularTerm = 1, ambientTerm = 2, hazeTerm = 3, transmittanceTerm = 4,
                      wholeTerm = 5;
constexpr std::array termModes{Channel::lit_diffuse, Channel::lit_specular, Channel::lit_ambient,
                               Channel::lit_haze, Channel::transmittance};

using Terms = std::array<const Image*, 5>;

Terms termsOf(const ChannelTerms& terms) {
    return {&terms.diffuse, &terms.specular, &terms.ambient, &terms.haze, &terms.transmittance};
}

Terms termsOf(const Frame& frame) {
    Terms terms{};
    for (std::size_t t = 0; t < termModes.size(); ++t) terms.at(t) = &frame.channels.at(termModes.at(t));
    return terms;
}

// The sum of terms, in the order of lit(Radiance) in shaders/lib/shading/radiance.glsl, so that another order
// is detected.
float sumOf(const std::array<float, 5>& t, float emission) {
    return (((t[diffuseTerm] + t[specularTerm]) + t[ambientTerm]) + emission) * t[transmittanceTerm] +
           t[hazeTerm];
}

std::array<float, 5> termsAt(const Terms& terms, std::size_t i) {
    std::array<float, 5> values{};
    for (std::size_t t = 0; t < values.size(); ++t) values.at(t) = terms.at(t)->data[i];
    return values;
}

void forEach(std::size_t count, const auto& what) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) what(i);
    });
}

Image sumOf(const Terms& terms, const Image& emission) {
    Image sum(emission.width, emission.height, 3);
    float* const out = sum.data.data();
    forEach(sum.data.size(), [&](std::size_t i) { out[i] = sumOf(termsAt(terms, i), emission.data[i]); });
    return sum;
}

// The part of a direct term's `change` due to a visibility change from `test` to `baseline`, where the
// test's term is `value`. It scales the term by the ratio, and is never more than the whole change.
float shadowPart(float change, float value, float baseline, float test) {
    if (baseline == test || change == 0) return 0;
    if (!(test > 0)) return change;
    const float scaled = value * (baseline / test - 1);
    if (scaled * change <= 0) return 0;
    return std::abs(scaled) < std::abs(change) ? scaled : change;
}

// The residual of each term, and of lit. The latter is `seen` minus the sum of a side's terms, minus the same
// for our lighting: the background and blended surfaces.
TermImages residualOf(const Image& seen, const Terms& terms, const LitSurfaces& own) {
    const Terms ours = termsOf(own.terms);
    TermImages residual;
    for (std::size_t t = 0; t < terms.size(); ++t) residual.at(t) = differenceOf(*terms.at(t), *ours.at(t));
    residual[wholeTerm] = Image(seen.width, seen.height, 3);
    float* const out = residual[wholeTerm].data.data();
    forEach(seen.data.size(), [&](std::size_t i) {
        const float emission = own.emission->data[i];
        const float beyond = seen.data[i] - sumOf(termsAt(terms, i), emission);
        const float left = beyond - (own.lit.data[i] - sumOf(termsAt(ours, i), emission));
        if (std::isfinite(left)) out[i] = left;
    });
    return residual;
}

// Moves from `change` the direct light that changes with the channel of `a` and `b`. `value`: the test's
// terms.
TermImages takeDirectLight(TermImages& change, const Terms& value, const Image* a, const Image* b,
                           const auto& part) {
    TermImages taken;
    for (const std::size_t t : {diffuseTerm, specularTerm}) {
        const Image& term = *value.at(t);
        if (!a || !b || a->pixels() != term.pixels() || b->pixels() != term.pixels()) return {};
        taken.at(t) = Image(term.width, term.height, 3);
        float *const out = taken.at(t).data.data(), *const left = change.at(t).data.data();
        forEach(term.data.size(), [&](std::size_t i) {
            out[i] = part(left[i], term.data[i], a->pixel(i / 3)[0], b->pixel(i / 3)[0]);
            left[i] -= out[i];
        });
    }
    return taken;
}

enum class ResidualSource : std::uint8_t { background, blended, emitting, other };

// The source of each component of a change beyond the sum of terms. blended: our lighting of either side
// blends surfaces there. emitting: it may come from adding emission differently, because it is at most a
// side's emission, and so is 99 % of the change without blending. If other surfaces change too, emission is
// not the cause.
std::vector<ResidualSource> residualSources(const Image& change, const std::array<const Image*, 2>& ids,
                                            const std::array<LitSurfaces, 2>& own,
                                            const std::array<Terms, 2>& terms) {
    constexpr float rounding = 1.001f;
    std::vector<ResidualSource> sources(change.data.size(), ResidualSource::other);
    for (const LitSurfaces& side : own)
        for (std::size_t i = 0; i < sources.size(); ++i)
            if (side.lit.data[i] != side.unblended.data[i])
                std::fill_n(sources.begin() + static_cast<std::ptrdiff_t>(i - i % 3), 3,
                            ResidualSource::blended);
    double all = 0, part = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (sources[i] == ResidualSource::blended) continue;
        float emitted = 0;
        for (std::size_t side = 0; side < 2; ++side)
            emitted = std::max(
                emitted, own.at(side).emission->data[i] * terms.at(side).at(transmittanceTerm)->data[i]);
        const float size = std::abs(change.data[i]);
        const bool emits = size > 0 && emitted > 0 && size <= rounding * emitted;
        all += double{size};
        if (emits) part += double{size};
        if (!(ids[0]->pixel(i / 3)[0] >= 0) && !(ids[1]->pixel(i / 3)[0] >= 0))
            sources[i] = ResidualSource::background;
        else if (emits)
            sources[i] = ResidualSource::emitting;
    }
    if (!(part > 0) || part < 0.99 * all)
        std::ranges::replace(sources, ResidualSource::emitting, ResidualSource::other);
    return sources;
}

}  // namespace

std::vector<Channel> termChannels() {
    return {termModes.begin(), termModes.end()};
}

Image sumOfLobes(const LightChannels& of) {
    Image sum = of.diffuse;
    for (std::size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += of.specular.data[i];
    return sum;
}

Image sumOfTerms(const Frame& frame) {
    const Image& ids = channelOf(frame, Channel::material_id);
    Image sum = sumOf(termsOf(frame), channelOf(frame, Channel::emission));
    for (std::size_t i = 0; i < sum.data.size(); ++i)
        if (!(ids.pixel(i / 3)[0] >= 0)) sum.data[i] = 0;
    return sum;
}

// Without a surface all terms are 0, including transmittance.
Image sumOfTerms(const ChannelTerms& terms, const Image& emission) {
    return sumOf(termsOf(terms), emission);
}

LightingComponents::LightingComponents(const Frame& baseline, const Frame& test, const Image& lit,
                                       const std::array<LitSurfaces, 2>& own) {
    const std::array<Terms, 2> terms{termsOf(baseline), termsOf(test)};
    residual_ = residualOf(lit, terms[1], own[1]);
    const TermImages baselines = residualOf(channelOf(baseline, Channel::lit), terms[0], own[0]);
    TermImages change;
    for (std::size_t t = 0; t < change.size(); ++t)
        change.at(t) = differenceOf(baselines.at(t), residual_.at(t));
    // Splits off direct light that changes with the visibility of lights, or where other lights are
    // evaluated.
    const auto contribution = [&](std::string name, std::string description, Channel channel, LightChange how,
                                  const auto& part) {
        add({std::move(name), std::move(description),
             takeDirectLight(change, terms[1], findChannel(baseline, channel), findChannel(test, channel),
                             part),
             how});
    };
    contribution("shadow_visibility", "direct light that changes with the visibility of the sun",
                 Channel::shadow_visibility, LightChange::visibility, shadowPart);
    contribution("local_visibility", "direct light that changes with the visibility of point and spot lights",
                 Channel::local_visibility, LightChange::visibility, shadowPart);
    contribution("light_count", "direct light where the number of evaluated lights differs",
                 Channel::light_count, LightChange::whole,
                 [](float left, float, float a, float b) { return a != b ? left : 0.0f; });
    const auto term = [&](std::string name, std::string description, std::initializer_list<std::size_t> of,
                          std::optional<LightChange> how = {}) {
        TermImages adds;
        for (const std::size_t t : of) adds.at(t) = std::move(change.at(t));
        add({std::move(name), std::move(description), std::move(adds), how});
    };
    term("direct diffuse", "direct light that the diffuse lobes reflect or transmit", {diffuseTerm},
         LightChange::factor);
    term("direct specular", "direct light reflected by the specular lobe", {specularTerm},
         LightChange::factor);
    term("ambient light", "ambient and environment light, reflected or transmitted", {ambientTerm});
    term("haze in the air", "transmittance and scattered light of the haze", {hazeTerm, transmittanceTerm});
    const Image beyond = std::move(change.at(wholeTerm));
    const std::vector<ResidualSource> sources = residualSources(
        beyond, {&channelOf(baseline, Channel::material_id), &channelOf(test, Channel::material_id)}, own,
        terms);
    const auto whole = [&](ResidualSource source, std::string name, std::string description) {
        Image& part = change.at(wholeTerm) = Image(beyond.width, beyond.height, 3);
        for (std::size_t i = 0; i < sources.size(); ++i)
            if (sources[i] == source) part.data[i] = beyond.data[i];
        term(std::move(name), std::move(description), {wholeTerm});
    };
    whole(ResidualSource::background, "background", "pixels without a surface and without blending");
    whole(ResidualSource::blended, "transparency",
          "fragments blended over surfaces and background, and transmission through surfaces");
    whole(ResidualSource::emitting, "sum with emission",
          "difference between lit and the sum of its terms, only where surfaces emit");
    whole(ResidualSource::other, "sum of terms",
          "difference between lit and the sum of its terms: another order or an unknown term");
}

void LightingComponents::add(Component component) {
    bool nothing = true;
    for (Image& image : component.adds) {
        if (std::ranges::all_of(image.data, [](float value) { return value == 0; })) image = Image();
        nothing = nothing && image.empty();
    }
    if (!nothing) components_.push_back(std::move(component));
}

Image LightingComponents::directLight(const Component& component, const LightChannels& of) {
    if (component.adds.at(diffuseTerm).empty()) return of.specular;
    return component.adds.at(specularTerm).empty() ? of.diffuse : sumOfLobes(of);
}

LightChannels LightingComponents::change(const Component& component) {
    return {component.adds.at(diffuseTerm), component.adds.at(specularTerm)};
}

Image LightingComponents::lit(const LitSurfaces& surfaces, const std::vector<bool>& taken) const {
    Image lit(surfaces.lit.width, surfaces.lit.height, 3);
    const Terms terms = termsOf(surfaces.terms);
    std::array<std::vector<const float*>, 6> added;
    for (std::size_t t = 0; t < added.size(); ++t) {
        added.at(t).push_back(residual_.at(t).data.data());
        for (std::size_t s = 0; s < components_.size(); ++s)
            if (taken.at(s) && !components_[s].adds.at(t).empty())
                added.at(t).push_back(components_[s].adds.at(t).data.data());
    }
    float* const out = lit.data.data();
    forEach(lit.data.size(), [&](std::size_t i) {
        const std::array<float, 5> mine = termsAt(terms, i);
        std::array<float, 5> theirs = mine;
        for (std::size_t t = 0; t < theirs.size(); ++t)
            for (const float* const more : added.at(t)) theirs.at(t) += more[i];
        const float emission = surfaces.emission->data[i];
        float value = sumOf(theirs, emission) + (surfaces.lit.data[i] - sumOf(mine, emission));
        for (const float* const more : added.at(wholeTerm)) value += more[i];
        out[i] = value;
    });
    return lit;
}

}  // namespace diptych
