// SPDX-License-Identifier: MIT
#include "compare/audit/auditor.h"

#include "compare/audit/quantities.h"
#include "compare/audit/report.h"
#include "compare/audit/small_scene.h"
#include "compare/experiment/row_checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

namespace diptych::audit {

Auditor::Auditor(const AuditQuestion& question, Audited audited, const Subject& subject, Device& device,
                 std::function<void(const std::string&)> onStep)
    : question_(question),
      subject_(subject),
      audit_{std::move(audited), {}, {}, {}, {}, 0},
      measurer_(device, subject, std::move(onStep)),
      checkpoint_(question.folder, "audit", key()) {}

// Inputs of a step besides its magnitude and series.
nlohmann::ordered_json Auditor::key() {
    nlohmann::ordered_json key =
        experiment::keyOf(audit_.scene, measurer_.fingerprint(), audit_.settings, audit_.device);
    key["lights"] = lightsFileOf(subject_.original);
    return key;
}

void Auditor::measure(const Stage& stage, const std::function<void(const QuantityAudit&)>& onFinished) {
    // Required quantities are measured too.
    std::vector<std::string> names = question_.quantities;
    for (const auto& [name, magnitude] : question_.required)
        if (!names.empty()) names.push_back(name);
    const std::vector<const Quantity*> all = quantitiesOf(names);
    for (const Quantity* quantity : all) audit_.to_come.emplace_back(quantity->name);
    for (std::size_t q = 0; q < all.size(); ++q) {
        const auto count = static_cast<double>(all.size()), at = static_cast<double>(q);
        audit_.to_come.erase(audit_.to_come.begin());
        measure(*all[q], stage.part(0.02 + 0.96 * at / count, 0.02 + 0.96 * (at + 1) / count));
        onFinished(audit_.quantities.back());
        // Plots of finished quantities can be viewed while others are measured.
        const bool shown = audit_.quantities.back().lacks.empty();
        if (shown && q + 1 < all.size()) writeAudit(audit_, question_.folder, question_.force);
    }
    for (const auto& [name, magnitude] : question_.required)
        for (const QuantityAudit& quantity : audit_.quantities)
            if (quantity.quantity->name == name) audit_.requirements.push_back(evaluate(quantity, magnitude));
}

void Auditor::measure(const Quantity& quantity, const Stage& stage) {
    const auto steps = static_cast<double>(quantity.magnitudes.size() + 4);  // plus some in between
    double done = 0;
    std::vector<double> required;
    for (const auto& [name, magnitude] : question_.required)
        if (name == quantity.name) required.push_back(magnitude);
    audit_.quantities.push_back(auditQuantity(
        quantity, subject_,
        [&](std::span<const Series> series, double magnitude) {
            stage.at(std::min(done / steps, 1.0),
                     fmt::format("{} {}", quantity.name, magnitudeText(magnitude)));
            done += 1;
            return stepAt(quantity, series, magnitude);
        },
        required));
    stage.at(1, fmt::format("{}: reduce failures", quantity.name));
    addFailures(audit_.quantities.back(), subject_, measurer_, question_, audit_.scenes);
}

Step Auditor::stepAt(const Quantity& quantity, std::span<const Series> series, double magnitude) {
    const std::string name = fmt::format("{}-{:.17g}", quantity.name, magnitude);
    const auto whole = [&](const nlohmann::ordered_json& json) {
        Step step = stepFromJson(json);
        return step.outcomes.size() == series.size() ? std::optional(std::move(step)) : std::nullopt;
    };
    if (const std::optional<Step> step = experiment::findCheckpoint(checkpoint_, name, whole)) {
        ++audit_.resumed;
        return *step;
    }
    Step step = measurer_.measure(quantity, series, magnitude);
    for (Outcome& outcome : step.outcomes) outcome.scene = audit_.scene;
    checkpoint_.keep(name, toJson(step));
    return step;
}

std::string Auditor::write() {
    std::string json = writeAudit(audit_, question_.folder, question_.force);
    checkpoint_.remove();
    return json;
}

}  // namespace diptych::audit
