// SPDX-License-Identifier: MIT
// How one pixel came to its light in both paths: its surface, channel by channel in the order in which they
// are made, the lights of its list, what each light adds in either path and in the reference, and the first
// step at which the paths differ.
#pragma once

#include "compare/render/renderer.h"
#include "compare/run/progress.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene_view.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// So many lights are drawn alone, of those that the pixel evaluates the ones that send most; the others are
// drawn together.
inline constexpr std::size_t lightsDrawnAlone = 32;

struct PixelQuery {
    int x = 0, y = 0;               // from the top left, within the picture
    Settings baseline, test;        // of the two paths, in any order
    Settings reference;             // of the same view
    ReportDevice device;            // that they are drawn on
    std::span<const Rule> rules{};  // in place of the derived tolerances
    std::string light_differs{};    // as CompareOptions::light_differs
    Stage progress{};
};

// The components of a channel; empty where the side has no such channel.
using PixelValue = std::vector<double>;

// A channel at the pixel.
struct PixelStep {
    const DebugMode* mode = nullptr;
    std::array<PixelValue, 2> values;  // baseline, test
    PixelValue reference;
    double difference = 0;  // of the two, in the channel's metric
    bool differs = false;   // by more than rounding: on a CPU device by a bit, on a GPU by over 16 ULP
    Tolerance tolerance;    // at this pixel: infinite where a rule bounds nothing at single pixels
    bool beyond = false;    // the tolerance, or not what the encoding explains
    std::optional<bool> explained{};  // lit channels: deferred is what forward+ shades from decoded surfaces

    bool isCompared() const { return !values[0].empty() && !values[1].empty(); }
};

// A part of the pixel's light, W/(sr m^2).
struct PixelTerm {
    enum class Kind {
        light,         // one light alone, with its shadow: what the surface reflects of it
        other_lights,  // those that were not drawn alone, together
        environment,
        ambient,        // ambient light and lightmaps
        emission,       // what the surface emits, an unlit one its colour
        transmittance,  // no part: the share of all the above that haze lets through
        haze,           // what haze adds
        blended,        // what blended surfaces before it add and hide
        sum,            // of all the above, in double
        lit,            // the picture
        residual        // lit less the sum
    };
    Kind kind = Kind::light;
    std::vector<std::size_t> lights{};  // that it is of, as places in SceneView::lights
    std::array<std::array<double, 3>, 2> values{};
    std::optional<std::array<double, 3>> reference{};
    double uncertainty = 0;  // of the reference: half the 95 % confidence interval, the largest component
    double difference = 0;   // of the two, in the metric of lit
    bool differs = false;    // as PixelStep::differs; never of sum and residual
};
std::string_view nameOf(PixelTerm::Kind kind);  // "other_lights"

// What is said of a light of the scene.
struct PixelLightFacts {
    std::string name;  // as the file has it, fit for a line; may be empty
    std::string_view kind;
    double distance = 0;  // m, from the pixel's position; infinite for a directional light
    double range = 0;     // m; may be infinite
    bool casts = false;   // a shadow
    std::array<bool, 2> listed{false, false};
};

struct PixelBreakdown {
    std::string scene, camera;
    int x = 0, y = 0;
    Size size;
    std::array<Settings, 2> settings;  // baseline, test
    ReferenceMode mode = ReferenceMode::surface;
    std::array<std::string, 2> names;  // "deferred"
    bool shown = false;                // an opaque surface, in either path; else the background
    bool blended = false;              // something blended changes lit in either path
    int material = -1;                 // of the baseline's, or else of the test's
    std::string material_name;         // fit for a line; may be empty
    std::array<double, 3> position{};  // of the same, world, m
    std::vector<PixelStep> steps;      // in the order in which they are made
    // By place in SceneView::lights. `lists_known`: whether their `listed` could be told, by path.
    std::vector<PixelLightFacts> lights;
    std::array<bool, 2> lists_known{false, false};
    std::vector<PixelTerm> terms;  // empty in the background; sum, lit and residual are the last ones
    std::array<double, 3> residual_rounding{};  // how far float32 sums may be from those in double: baseline,
                                                // test; of the reference, which is double, its uncertainty
    std::size_t drawn_alone = 0;                // lights

    // The place in `steps` of the first that differs, before the light's; in `terms`; in `steps` after these.
    struct First {
        const PixelStep* step = nullptr;
        const PixelTerm* term = nullptr;
    };
    First first() const;            // neither: none differs
    std::size_t differing() const;  // steps and terms that differ
};

// Whether a channel is made after the lights' terms: of these, or of what lies before the surface.
bool isAfterTerms(int mode);
// Every channel's number in the order in which a pixel comes to them.
std::span<const int> pixelSteps();

// Draws the view by both paths, the pixel by the reference, and each light alone that `lightsDrawnAlone`
// tells. `views` are the renderer's. Throws std::runtime_error, one line, as Renderer does.
PixelBreakdown pixelBreakdown(Renderer& renderer, SceneViews& views, const PixelQuery& query);

}  // namespace diptych
