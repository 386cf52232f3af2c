// SPDX-License-Identifier: MIT
#include "compare/audit/auditor.h"

#include "compare/audit/reduce.h"
#include "compare/audit/report.h"
#include "compare/audit/small_scene.h"
#include "compare/page/text.h"
#include "compare/run/command_text.h"
#include "shared/image/atomic_file.h"
#include "shared/image/temporary.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <cerrno>
#include <span>
#include <stdexcept>
#include <system_error>

namespace diptych::audit {

namespace {

constexpr std::size_t maxTried = 120;  // cases that a reduction renders

struct Broken {
    std::size_t series = 0, criterion = 0;
    double magnitude = 0;
};

// The first precise series that fails by a criterion of errors, where it first fails.
std::optional<Broken> firstBroken(const QuantityAudit& of, const Subject& subject) {
    for (const std::size_t criterion : {numberCriterion, requiredCriterion})
        for (std::size_t s = 0; s < of.series.size(); ++s) {
            const ValidRange& range = of.valid_ranges[criterion][s];
            if (!range.at_original || !isPrecise(of.series[s].applied(subject.original.settings))) continue;
            for (const BreakingPoint* point : {&range.up, &range.down})
                if (point->broken) return Broken{s, criterion, point->first};
        }
    return {};
}

}  // namespace

void addFailures(QuantityAudit& of, const Subject& subject, Measurer& measurer, const AuditQuestion& question,
                 std::map<std::string, std::string>& scenes) {
    if (of.steps.empty()) return;
    const std::optional<Broken> broken = firstBroken(of, subject);
    if (!broken) return;
    const Series& series = of.series[broken->series];
    const BreakCriterion& criterion = criteria[broken->criterion];
    Case changed = subject.original;
    of.quantity->apply(changed, subject, broken->magnitude);
    const auto test = [&](const Case& candidate) {
        const Step step = measurer.measure(candidate, std::span(&series, 1));
        const Outcome& outcome = step.outcomes.front();
        // An empty image shows no failure.
        const bool drawn = outcome.failed.empty() && step.isCovered();
        return FailingPixel{drawn && !passes(criterion, outcome), outcome.worst_x, outcome.worst_y,
                            outcome.error()};
    };
    const std::string at =
        fmt::format("{} breaks at {}", series.describe(), magnitudeText(broken->magnitude, *of.quantity));
    const std::optional<Reduced> reduced = reduce(changed, test, maxTried);
    Failure& failure = of.failures.emplace_back();
    if (!reduced) {
        failure.text = at + "; it does not occur without the scene's textures, environment and animation";
        return;
    }
    failure.scene = fmt::format("{}.gltf", of.quantity->name);
    const std::string lights = fmt::format("{}.lights.json", of.quantity->name);
    scenes[failure.scene] = gltfOf(reduced->smallest);
    scenes[lights] = lightsFileOf(reduced->smallest);
    const Settings& small = reduced->smallest.settings;
    failure.text = fmt::format("{}; {}, {} and {}x{} pixels reproduce it: error {}", at,
                               counted(triangleCount(reduced->smallest.scene), "triangle"),
                               counted(reduced->smallest.scene.lights.size(), "light"), small.size.width,
                               small.size.height, page::number(reduced->shown.error));
    const std::filesystem::path root = std::filesystem::absolute(std::filesystem::temp_directory_path());
    Temporary trial(root, root / "diptych-audit");
    if (!trial.createFolder(true)) throw std::system_error(errno, std::generic_category(), root);
    for (const std::string& file : {failure.scene, lights}) writeFile(trial.path() / file, scenes[file]);
    // Command line of a comparison with the reference, for the scene and lights in a folder. Mode surface
    // compares light; only mode scene detects wrong surfaces.
    const auto wordsIn = [&](const std::filesystem::path& folder, ReferenceMode mode) {
        Settings asked = series.applied(small);
        asked.lights = (folder / lights).string();
        asked.path = Settings().path;
        asked.reference_mode = mode;
        const auto compare = commandArguments("compare", (folder / failure.scene).string(), asked);
        return withArguments(withOption(compare, "--baseline", "reference"), question.words);
    };
    try {
        for (const ReferenceMode mode : {ReferenceMode::surface, ReferenceMode::scene})
            if (failure.command.empty() && question.fails(wordsIn(trial.path(), mode), trial.path()))
                failure.command = shellLine(wordsIn(question.folder, mode));
        if (failure.command.empty()) failure.text += "; compare tolerates this error and passes";
    } catch (const std::runtime_error& error) {
        failure.text += fmt::format("; it was not reproduced: {}", error.what());
    }
}

}  // namespace diptych::audit
