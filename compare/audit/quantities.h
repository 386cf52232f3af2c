// SPDX-License-Identifier: MIT
// Stress parameters of an audit, varied one at a time, with the magnitudes to try.
#pragma once

#include "compare/audit/case.h"
#include "compare/experiment/change.h"
#include "shared/text/did_you_mean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::audit {

using experiment::Change;

// Predicted magnitudes at which arithmetic fails.
struct Predicted {
    static constexpr double never = std::numeric_limits<double>::infinity();
    double up = never, down = 0;  // above and below the default magnitude
    std::string because{};        // "float32 has 24 bits: ..."; empty: no prediction
    // Only arithmetic ends there; approximations of light may fail earlier, by an unpredicted amount.
    bool at_most = false;
};

// A quantity or relation needs these, beside something to draw. A call returns the reason why the first unmet
// one is not met; empty if all are.
class Preconditions {
public:
    using Lacks = std::string (*)(const Subject&);  // empty: met
    Preconditions(std::initializer_list<Lacks> all) : all_(all) {}
    std::string operator()(const Subject& subject) const;

private:
    std::vector<Lacks> all_;
};

// Shared preconditions.
std::string lacksPerspective(const Subject& subject);
std::string lacksSurface(const Subject& subject);  // for a perspective camera
std::string lacksLocalLight(const Subject& subject);
std::string lacksSun(const Subject& subject);

double originalOne(const Subject& subject);

struct Quantity {
    std::string_view name;                             // "offset"
    std::string_view unit{};                           // "m"; may be empty
    std::string_view what;                             // "distance of local lights from the camera"
    std::vector<double> magnitudes;                    // ascending; above 0, but for a first one of 0
    double (*original)(const Subject&) = originalOne;  // that of the original scene, or one that looks alike
    Preconditions lacks = {};
    // Modifies an original case.
    void (*apply)(Case&, const Subject&, double magnitude);
    // Relevant Settings, each tried beside the original ones.
    std::vector<Change> variants = {};
    // Whether the image stays that of the original scene, which is then the truth. `light`, `lengths`:
    // except that its light or its lengths are multiplied by the magnitude.
    bool same_image = false, light = false, lengths = false;
    bool of_images = false;  // only changes Case::exposure, so frames stay the same
    bool whole = false;      // magnitudes are integers
    // Prediction: the magnitude at which arithmetic fails in any scene, and why; or, if it depends on scene,
    // Settings or the relative error that a path reaches there, a function of them.
    double fails_at = Predicted::never;
    std::string_view because = {};
    Predicted (*predict)(const Subject&, const Settings&, double error) = nullptr;
    bool predicts_formats = false;  // also predicts depth formats other than reversed floats
};

// Whether arithmetic is the only error of a path with these Settings; predictions assume so.
bool isPrecise(const Settings& settings);

std::span<const Quantity> quantities();

// Rows with these names, or all if there are none, in the order of `all`. Throws std::runtime_error with
// `option` and the first unknown name; `kind`: "quantity".
template <class Row>
std::vector<const Row*> rowsNamed(std::span<const std::string> names, std::span<const Row> all,
                                  std::string_view option, std::string_view kind) {
    std::vector<std::string> known;
    for (const Row& row : all) known.emplace_back(row.name);
    for (const std::string& name : names)
        if (std::ranges::count(known, name) == 0)
            throw std::runtime_error(fmt::format("{} {}: there is no such {}{}; there are {}", option, name,
                                                 kind, didYouMean(name, known), fmt::join(known, ", ")));
    std::vector<const Row*> found;
    for (const Row& row : all)
        if (names.empty() || std::ranges::count(names, row.name) > 0) found.push_back(&row);
    return found;
}
inline std::vector<const Quantity*> quantitiesOf(std::span<const std::string> names,
                                                 std::string_view option = "--quantity") {
    return rowsNamed(names, quantities(), option, "quantity");
}

// Quantities by subject; quantities() returns all.
std::vector<Quantity> transformQuantities();  // position and size of the scene, and its camera
std::vector<Quantity> lightQuantities();      // lights
std::vector<Quantity> shadingQuantities();    // materials, shadow maps and haze
std::vector<Quantity> amountQuantities();     // amounts: lights, triangles, pixels, seconds

// first, first * step, ... up to last, all rounded to three digits; and others, in ascending order.
std::vector<double> ladder(double first, double last, double step = 10,
                           std::initializer_list<double> others = {});

// Distance of the nearest local light from a point, m; infinite without one.
double localDistance(const Subject& subject, const glm::dvec3& from);

}  // namespace diptych::audit
