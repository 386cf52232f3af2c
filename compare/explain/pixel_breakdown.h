// SPDX-License-Identifier: MIT
// Breakdown of one pixel's light in both paths: its surface channels in order of computation, the lights
// of its list, each light's contribution in either path and in the reference, and the first step at which
// the paths differ.
#pragma once

#include "compare/output/document.h"
#include "compare/render/renderer.h"
#include "compare/run/progress.h"
#include "compare/verdict/rules.h"
#include "compare/verdict/tolerance.h"
#include "shared/frame/frame.h"
#include "shared/scene/scene_view.h"

#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Number of lights rendered one by one: those of the pixel's lights that contribute most. The others are
// rendered together.
inline constexpr std::size_t lightsDrawnAlone = 32;

struct PixelQuery {
    int x = 0, y = 0;               // from the top left, within the image
    Settings baseline, test;        // of the two paths, in any order
    Settings reference;             // of the same view
    ReportDevice device;            // that renders them
    std::span<const Rule> rules{};  // replace the derived tolerances
    std::string light_differs{};    // as CompareOptions::light_differs
    Stage progress{};
};

// Components of a channel; empty if the side lacks it.
using PixelValue = std::vector<double>;

// A channel at the pixel.
struct PixelStep {
    const DebugMode* mode = nullptr;
    std::array<PixelValue, 3> values;  // baseline, test, reference
    double difference = 0;             // of the two paths, in the channel's error kind
    bool differs = false;              // beyond rounding: any bit on a CPU device, over 16 ULP on a GPU
    Tolerance tolerance;               // at this pixel; infinite if a rule does not bound single pixels
    bool beyond = false;               // out of tolerance, or not explained by the encoding
    std::optional<bool> explained{};   // lit channels: deferred equals forward+ shading decoded surfaces

    bool isCompared() const { return !values[0].empty() && !values[1].empty(); }
};

// A term of the pixel's light, W/(sr m^2).
struct PixelTerm {
    enum class Kind {
        light,         // reflection of one light alone, with its shadow
        other_lights,  // the lights not rendered alone, together
        environment,
        ambient,        // ambient light and lightmaps
        emission,       // emitted light; for unlit surfaces their colour
        transmittance,  // no summand: the fraction of all the above that haze transmits
        haze,           // light that haze adds
        blended,        // what blended surfaces in front add and hide
        sum,            // of all the above, in double
        lit,            // the image's value
        residual        // lit minus the sum
    };
    Kind kind = Kind::light;
    std::vector<std::size_t> lights{};   // its lights, as indices in SceneView::lights
    std::array<glm::dvec3, 3> values{};  // baseline, test, reference
    bool has_reference = true;
    double uncertainty = 0;  // of the reference: half the 95 % confidence interval, largest component
    double difference = 0;   // of the two paths, in lit's error kind
    bool differs = false;    // as PixelStep::differs; always false for sum and residual
};

// Description of a light of the scene.
struct PixelLightProperties {
    std::string name;  // as in the file, for one line; may be empty
    std::string_view kind;
    double distance = 0;  // m, from the pixel's position; infinite for a directional light
    double range = 0;     // m; may be infinite
    bool casts = false;   // whether it casts a shadow
};

struct PixelBreakdown {
    std::string scene, camera;
    int x = 0, y = 0;
    std::array<Settings, 2> settings;  // baseline, test
    ReferenceMode mode = ReferenceMode::surface;
    std::array<std::string, 2> names;          // "deferred"
    bool shown = false;                        // either path shows an opaque surface; else the background
    bool blended = false;                      // a blended surface changes lit in either path
    int material = -1;                         // the baseline's, or else the test's
    std::string material_name;                 // for one line; may be empty
    glm::dvec3 position{0};                    // of the same surface, world, m
    std::vector<PixelStep> steps;              // in order of computation
    std::vector<PixelLightProperties> lights;  // by index in SceneView::lights
    // The lights that each path evaluates, ascending indices; empty optional: unknown.
    std::array<std::optional<std::vector<std::size_t>>, 2> lists{};
    std::vector<PixelTerm> terms;  // empty in the background; ends with sum, lit and residual
    // Largest difference of the sums from those in double: float32 rounding for baseline and test,
    // uncertainty for the reference.
    std::array<double, 3> residual_rounding{};
    std::size_t drawn_alone = 0;  // number of lights

    // The first difference, in order: `steps` before the light terms, `terms`, then the remaining `steps`.
    // Both nullptr: no difference.
    std::pair<const PixelStep*, const PixelTerm*> first() const;
};

// Whether a channel is computed after the light terms: from them, or from what is in front of the surface.
bool isAfterTerms(Channel mode);
// Every channel's number, in order of computation.
std::span<const Channel> pixelSteps();

// Renders the view by both paths, the pixel by the reference, and up to `lightsDrawnAlone` lights alone.
// `views`: those of the renderer. Throws std::runtime_error, one line, like Renderer.
PixelBreakdown pixelBreakdown(Renderer& renderer, SceneViews& views, const PixelQuery& query);

// The largest absolute component.
double largest(const glm::dvec3& value);

std::vector<output::Block> blocksOf(const PixelBreakdown& breakdown);
nlohmann::ordered_json toJson(const PixelBreakdown& breakdown);

// "the first step that differs by more than rounding: roughness (0.301 against 0.298, 0.003 in its metric,
// absolute, tolerance 0.002: ...)", or that there is none. One line without a newline.
std::string firstDifference(const PixelBreakdown& breakdown);

}  // namespace diptych
