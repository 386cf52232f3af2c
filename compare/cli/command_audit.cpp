// SPDX-License-Identifier: MIT
#include "compare/audit/audit.h"
#include "compare/audit/failures.h"
#include "compare/audit/quantities.h"
#include "compare/audit/small_scene.h"
#include "compare/audit/words.h"
#include "compare/audit/write.h"
#include "compare/cli/audit_opening.h"
#include "compare/cli/command_line.h"
#include "compare/cli/commands.h"
#include "compare/experiment/kept.h"
#include "compare/run/interruption.h"
#include "compare/run/print.h"
#include "shared/text/counted.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace diptych::cli {

using Json = nlohmann::ordered_json;

namespace {

// Defaults of an audit: a size that the reference renders in about 0.1 s, and no shadows. A shadow map's
// filter is an error by itself, so shadows are on only for shadow quantities.
Settings auditedSettings(const Options& options) {
    Settings settings = options.settings;
    if (!options.size_given) settings.size = {160, 90};
    if (!options.shadows_given) settings.shadows = Shadows::off;
    return settings;
}

void checkAuditOptions(const Options& options) {
    if (options.scenes.size() != 1)
        throw std::runtime_error(
            fmt::format("{}: audit takes one scene; run it once for each", options.scenes[1]));
    if (options.cameras.size() != 1)
        throw std::runtime_error(
            fmt::format("--camera {}: audit takes one camera; run it once for each", options.cameras[1]));
    if (options.path_given)
        throw std::runtime_error("--path: audit compares both paths with the reference; leave it out");
    if (options.settings.msaa > 1)
        throw std::runtime_error(
            "--msaa: audit compares one sample per pixel, like its reference; leave it out");
    if (const auto problem = auditedSettings(options).problem()) throw std::runtime_error(*problem);
}

// Temporary folder, removed by the destructor.
struct TrialFolder {
    std::filesystem::path path;

    TrialFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "diptych-audit-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::system_error(errno, std::generic_category(), name);
        path = name;
    }
    ~TrialFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TrialFolder(const TrialFolder&) = delete;
    TrialFolder& operator=(const TrialFolder&) = delete;
};

class Auditor {
public:
    explicit Auditor(const Options& options)
        : options_(options),
          settings_(auditedSettings(options)),
          opened_(options, settings_, "diptych-audit", "audit", audit::auditManifest),
          audit_{opened_.audited(), {}, {}, {}, {}, 0} {}

    int run() {
        const audit::Subject& subject = opened_.subject();
        const Stage& stage = opened_.stage();
        if (!options_.shadows_given)
            audit_.notes.emplace_back(
                "--shadows off, except for shadow quantities: a shadow filter's error would hide other "
                "errors");
        audit::Measurer measurer(opened_.device(), subject,
                                 [&](const std::string& step) { say(options_, step); });
        CheckpointFolder kept(opened_.folder(), "audit", keyOf(measurer, subject));
        if (kept.isRenewed())
            note(options_,
                 "the results of an interrupted audit belong to another scene, device or Settings; starting "
                 "anew");
        sayWhenInterrupted("finished steps are kept: the same command continues from there");
        // Quantities of --require are measured too.
        std::vector<std::string> names = options_.audit.quantities;
        for (const auto& [name, magnitude] : options_.audit.required)
            if (!names.empty()) names.push_back(name);
        const std::vector<const audit::Quantity*> all = audit::quantitiesOf(names);
        for (const audit::Quantity* quantity : all) audit_.to_come.emplace_back(quantity->name);
        for (std::size_t q = 0; q < all.size(); ++q) {
            const auto count = static_cast<double>(all.size()), at = static_cast<double>(q);
            audit_.to_come.erase(audit_.to_come.begin());
            measure(*all[q], subject, measurer, kept,
                    stage.part(0.02 + 0.96 * at / count, 0.02 + 0.96 * (at + 1) / count));
            // Plots of finished quantities can be viewed while others are measured.
            const bool shown = audit_.quantities.back().lacks.empty();
            if (shown && q + 1 < all.size()) audit::writeAudit(audit_, opened_.folder(), options_.force);
        }
        for (const auto& [name, magnitude] : options_.audit.required)
            for (const audit::QuantityAudit& quantity : audit_.quantities)
                if (quantity.quantity->name == name)
                    audit_.requirements.push_back(audit::evaluate(quantity, magnitude));
        checkValidation(opened_.device());
        stage.at(0.98, "write");
        if (audit_.kept > 0)
            note(options_, fmt::format("{} kept from an interrupted run", counted(audit_.kept, "step")));
        const std::string json = audit::writeAudit(audit_, opened_.folder(), options_.force);
        kept.remove();
        opened_.progress().wipe();
        bool met = true;
        for (const audit::Requirement& requirement : audit_.requirements) {
            met = met && requirement.met;
            opened_.print(audit::inWords(requirement));
        }
        if (options_.json) printText(json);
        opened_.print((opened_.folder() / "index.html").string() + "\n");
        return met ? 0 : 1;
    }

private:
    // Inputs of a step besides its magnitude and series.
    Json keyOf(audit::Measurer& measurer, const audit::Subject& subject) const {
        Json key = experiment::keyOf(audit_.scene, measurer.fingerprint(), settings_, audit_.device);
        key["lights"] = audit::lightsFileOf(subject.given);
        return key;
    }

    void measure(const audit::Quantity& quantity, const audit::Subject& subject, audit::Measurer& measurer,
                 const CheckpointFolder& kept, const Stage& stage) {
        const auto steps = static_cast<double>(quantity.magnitudes.size() + 4);  // plus some in between
        double done = 0;
        std::vector<double> required;
        for (const auto& [name, magnitude] : options_.audit.required)
            if (name == quantity.name) required.push_back(magnitude);
        audit_.quantities.push_back(audit::auditQuantity(
            quantity, subject,
            [&](std::span<const audit::Series> series, double magnitude) {
                stage.at(std::min(done / steps, 1.0),
                         fmt::format("{} {}", quantity.name, audit::magnitudeInWords(magnitude)));
                done += 1;
                const std::string name = fmt::format("{}-{:.17g}", quantity.name, magnitude);
                if (auto step = keptStep(kept, name, series.size())) {
                    ++audit_.kept;
                    return *step;
                }
                audit::Step step = measurer.measure(quantity, series, magnitude);
                kept.keep(name, audit::toJson(step));
                return step;
            },
            required));
        stage.at(1, fmt::format("{}: reduce failures", quantity.name));
        const TrialFolder folder;
        std::vector<std::string> device;
        if (!options_.device.empty()) device = {"--device", options_.device};
        const audit::Trial trial{folder.path, std::move(device), [&](std::vector<std::string> words) {
                                     return compareFails(std::move(words), folder.path);
                                 }};
        audit::addFailures(audit_.quantities.back(), subject, measurer, trial, opened_.folder(),
                           audit_.scenes);
        opened_.print(audit::inWords(audit_.quantities.back()));
    }

    // Runs a command exactly as the report would print it. Returns whether compare fails.
    bool compareFails(std::vector<std::string> words, const std::filesystem::path& folder) const {
        const std::string out = (folder / "report").string();
        words.insert(words.begin() + 1, {"--runs", "0", "--quiet", "--force", "--out", out});
        try {
            return runCommand(parseCommandLine(words)) == 1;
        } catch (const std::runtime_error& error) {
            say(options_, fmt::format("{}: does not reproduce the failure: {}", words.back(), error.what()));
            return false;
        }
    }

    static std::optional<audit::Step> keptStep(const CheckpointFolder& kept, const std::string& name,
                                               std::size_t series) {
        return experiment::findKept(kept, name, [&](const Json& json) {
            audit::Step step = audit::stepFromJson(json);
            return step.outcomes.size() == series ? std::optional(std::move(step)) : std::nullopt;
        });
    }

    const Options& options_;
    const Settings settings_;
    AuditOpening opened_;
    audit::Audit audit_;
};

}  // namespace

int runAudit(const Options& options) {
    checkAuditOptions(options);
    if (options.audit.relations) return runRelations(options, auditedSettings(options));
    return Auditor(options).run();
}

}  // namespace diptych::cli
