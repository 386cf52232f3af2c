// SPDX-License-Identifier: MIT
#include "compare/viewer/drawing/images.h"

#include "compare/metrics/channel.h"
#include "compare/verdict/measurement.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/supported_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <vector>

namespace diptych::viewer {
namespace {

std::string titleOf(const Frame& frame) {
    return frame.origin.file.empty() ? frame.name
                                     : std::filesystem::path(frame.origin.file).filename().string();
}

Panel panelOf(const Frame& frame, const DebugMode& mode, const ImageScale& scale) {
    Panel panel;
    panel.name = titleOf(frame);
    if (const Image* const image = findChannel(frame, mode.channel)) {
        panel.image = channelImage(mode, frame, scale);
        panel.values = *image;
        return panel;
    }
    panel.missing = unsupportedReason(frame.settings, mode);
    if (panel.missing.empty() || !frame.origin.file.empty())
        panel.missing = fmt::format("{} has no channel {}", panel.name, mode.name);
    return panel;
}

// The 99.9th percentile of the errors, so that a few outliers do not hide the rest.
double topOf(const Image& errors) {
    std::vector<double> sizes;
    double largest = 0;
    for (std::size_t i = 0; i < errors.pixels(); ++i) {
        const double size = std::abs(double{errors.pixel(i)[0]});
        if (!std::isfinite(size) || size == 0) continue;
        sizes.push_back(size);
        largest = std::max(largest, size);
    }
    if (sizes.empty()) return 0;
    const auto rank = static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(sizes.size() - 1));
    std::ranges::nth_element(sizes, sizes.begin() + rank);
    return sizes[static_cast<std::size_t>(rank)];
}

// test - baseline of the component where its magnitude is largest.
Image signedErrors(const Image& baseline, const Image& test, const Coverage& covered) {
    Image errors(baseline.width, baseline.height, 1);
    for (std::size_t i = 0; i < errors.pixels(); ++i) {
        if (!covered.covered[i]) continue;
        float max = 0;
        for (int c = 0; c < baseline.components; ++c)
            if (const float d = test.pixel(i)[c] - baseline.pixel(i)[c]; !(std::abs(d) <= std::abs(max)))
                max = d;
        errors.pixel(i)[0] = max;
    }
    return errors;
}

Image8 signedImage(const Image& errors, double top) {
    Image8 image{errors.width, errors.height, 3, std::vector<std::uint8_t>(3 * errors.pixels())};
    for (std::size_t i = 0; i < errors.pixels(); ++i) {
        const double value = double{errors.pixel(i)[0]};
        const std::array<std::uint8_t, 3> color =
            std::isfinite(value) ? signedColor(top > 0 ? value / top : 0) : nonfiniteColor;
        std::ranges::copy(color, image.data.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return image;
}

std::string unitOf(const DebugMode& mode) {
    if (mode.error_kind == ErrorKind::relative && mode.kind == ChannelKind::color) return ", W/(sr m^2)";
    if (mode.channel == Channel::depth || mode.channel == Channel::position ||
        mode.channel == Channel::transmission_thickness || mode.channel == Channel::attenuation_distance)
        return ", m";
    if (mode.channel == Channel::iridescence_thickness) return ", nm";
    return {};
}

// Difference images of the channel, over the pixels that show a surface in either image.
DifferencePanel measured(const DebugMode& mode, const Image& baseline, const Image& test,
                         const Coverage& covered, Difference kind) {
    DifferencePanel panel;
    switch (kind) {
        case Difference::none:
            break;
        case Difference::signed_difference:
            panel.is_signed = true;
            panel.values = signedErrors(baseline, test, covered);
            panel.text = "right - left, the largest component" + unitOf(mode);
            break;
        case Difference::absolute:
            panel.values = errorImage(ErrorKind::absolute, mode.kind, baseline, test, covered);
            panel.text = "|right - left|, the largest component" + unitOf(mode);
            break;
        case Difference::relative:
            panel.values = errorImage(ErrorKind::relative, mode.kind, baseline, test, covered);
            panel.text = "|right - left| / max(|left|, 1e-3 of the mean)";
            break;
        case Difference::flip: {
            const bool display = mode.error_kind != ErrorKind::relative;
            const Measurement measurement({.error_kind = mode.error_kind,
                                           .kind = mode.kind,
                                           .display = display,
                                           .reference = baseline,
                                           .test = test,
                                           .coverage = &covered});
            if (const HdrFlipResult* const flip = measurement.flip()) {
                panel.values = flip->error;
                panel.text = fmt::format("FLIP, mean {:.4g}", flip->mean);
            } else {
                panel.missing = fmt::format(
                    "FLIP needs a colour channel, and {} is not one: choose another difference", mode.name);
            }
            break;
        }
    }
    return panel;
}

}  // namespace

std::array<std::uint8_t, 3> signedColor(double t) {
    const double size = std::sqrt(std::min(std::abs(t), 1.0));
    const std::array<double, 3> end =
        t < 0 ? std::array<double, 3>{70, 150, 255} : std::array<double, 3>{255, 150, 40};
    if (std::abs(t) > 1) return beyondColor;
    return {static_cast<std::uint8_t>(std::lround(end[0] * size)),
            static_cast<std::uint8_t>(std::lround(end[1] * size)),
            static_cast<std::uint8_t>(std::lround(end[2] * size))};
}

Exposure exposureOf(const Frame& left, const Frame& right, const ViewOptions& view_options) {
    const Frame& frame = findChannel(left, Channel::lit) ? left : right;
    return exposureFor(view_options.image(), findChannel(frame, Channel::lit), coverage(frame, frame));
}

DifferencePanel differenceOf(const Frame& left, const Frame& right, const ViewOptions& view_options) {
    const DebugMode& mode = debugMode(view_options.channel());
    const Image *const baseline = findChannel(left, view_options.channel()), *const test = findChannel(
                                                                                 right,
                                                                                 view_options.channel());
    DifferencePanel panel;
    if (!baseline || !test) {
        panel.missing = fmt::format("only one of the two images has {}", mode.name);
        return panel;
    }
    if (baseline->width != test->width || baseline->height != test->height ||
        baseline->components != test->components) {
        panel.missing =
            fmt::format("{} is {}x{} and {} is {}x{}: set size to that of the stored image", titleOf(left),
                        baseline->width, baseline->height, titleOf(right), test->width, test->height);
        return panel;
    }
    panel = measured(mode, *baseline, *test, coverage(left, right), view_options.difference);
    if (!panel.missing.empty() || panel.values.empty()) return panel;
    panel.top = view_options.difference == Difference::flip ? 1 : topOf(panel.values);
    panel.image = panel.is_signed ? signedImage(panel.values, panel.top)
                                  : errorMap(panel.values, panel.top > 0 ? panel.top : 1);
    return panel;
}

void makeImages(const Frame& left, const Frame& right, const ViewOptions& view_options,
                const Exposure& exposure, DrawnView& shown) {
    const DebugMode& mode = debugMode(view_options.channel());
    std::vector<const Frame*> having;
    for (const Frame* frame : {&left, &right})
        if (findChannel(*frame, view_options.channel())) having.push_back(frame);
    ImageScale scale;
    if (!having.empty()) scale = scaleFor(mode, exposure, having);
    shown.panels = {panelOf(left, mode, scale), panelOf(right, mode, scale)};
    shown.scale = scale.text;
    shown.heat_top = isHeat(mode) && !having.empty() ? scale.high : 0;
    if (view_options.difference != Difference::none)
        shown.difference = differenceOf(left, right, view_options);
}

std::string_view nameOf(Against against) {
    switch (against) {
        case Against::paths:
            return "the other path";
        case Against::reference:
            return "the reference";
        case Against::file:
            return "a stored image";
    }
    return {};
}

std::string_view nameOf(Difference difference) {
    switch (difference) {
        case Difference::none:
            return "none";
        case Difference::signed_difference:
            return "signed";
        case Difference::absolute:
            return "absolute";
        case Difference::relative:
            return "relative";
        case Difference::flip:
            return "FLIP";
    }
    return {};
}

}  // namespace diptych::viewer
