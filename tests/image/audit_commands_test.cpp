// SPDX-License-Identifier: MIT
// The commands that an audit prints have been tried and reproduce the failure.
#include "compare/audit/auditor.h"
#include "compare/audit/quantities.h"
#include "tests/image/square.h"
#include "tests/tool/run.h"

#include <stdexcept>

namespace diptych::tests {
namespace {

using audit::Case;
using audit::Quantity;
using audit::Series;
using audit::Subject;

// An injected fault: images are four times too bright if the lamp has 4 cd or more. The program itself
// does not have it.
audit::QuantityAudit faultyAudit(audit::Measurer& measurer, const Subject& subject) {
    static const Quantity brightness{
        .name = "brightness",
        .unit = "cd",
        .what = "the lamp's intensity",
        .magnitudes = {1, 8},
        .original = [](const Subject&) { return 1.0; },
        .apply = [](Case& changed, const Subject&,
                    double candela) { changed.scene.lights[0].intensity = static_cast<float>(candela); }};
    measurer.plant({.image = [](const Case& drawn, Frame& frame) {
        if (drawn.scene.lights[0].intensity < 4) return;
        for (float& value : frame.channels.at(Channel::lit).data) value *= 4;
    }});
    return audit::auditQuantity(brightness, subject, [&](std::span<const Series> series, double magnitude) {
        return measurer.measure(brightness, series, magnitude);
    });
}

TEST(AuditCommands, AreThoseThatShowTheFailure) {
    Scene scene = square();
    Light lamp;
    lamp.position = {0, 0, 1};
    lamp.intensity = 1;
    scene.lights = {lamp};
    Settings settings = unshadowed();
    settings.size = {16, 9};
    const Subject subject = audit::makeSubject(scene, settings);
    audit::Measurer measurer(device(), subject, {});
    const audit::QuantityAudit whole = faultyAudit(measurer, subject);
    std::vector<std::string> tried;
    const auto failureOf = [&](const char* shows) {
        tried.clear();
        audit::QuantityAudit copy = whole;
        std::map<std::string, std::string> files;
        audit::AuditQuestion question;
        question.folder = "out";
        question.words = {"--device", "0"};
        question.fails = [&](const std::vector<std::string>& words, const fs::path& trial) {
            std::string line;
            for (const std::string& word : words) {
                line += word + " ";
                if (word.ends_with(".gltf") || word.ends_with(".json")) {
                    EXPECT_TRUE(fs::exists(word)) << word;
                    EXPECT_TRUE(word.starts_with(trial.string())) << word;
                }
            }
            tried.push_back(line);
            if (!*shows) throw std::runtime_error("no room");
            return line.find(shows) != line.npos;
        };
        audit::addFailures(copy, subject, measurer, question, files);
        EXPECT_EQ(files.size(), 2u);
        EXPECT_EQ(copy.failures.size(), 1u);
        return copy.failures.at(0);
    };
    const audit::Failure light = failureOf("--baseline reference");
    EXPECT_EQ(tried.size(), 1u);
    EXPECT_NE(light.command.find(" out/brightness.gltf"), std::string::npos) << light.command;
    EXPECT_NE(light.command.find("--lights out/brightness.lights.json"), std::string::npos) << light.command;
    EXPECT_NE(light.command.find("--device 0"), std::string::npos) << light.command;
    EXPECT_EQ(light.command.find("--reference-mode"), std::string::npos);
    const audit::Failure surfaces = failureOf("--reference-mode scene");
    EXPECT_EQ(tried.size(), 2u);
    EXPECT_NE(surfaces.command.find("--reference-mode scene"), std::string::npos) << surfaces.command;
    const audit::Failure none = failureOf("nothing");
    EXPECT_EQ(none.command, "");
    EXPECT_NE(none.text.find("compare tolerates this error and passes"), std::string::npos) << none.text;
    EXPECT_EQ(none.scene, "brightness.gltf") << "the scene is there all the same";
    const audit::Failure untried = failureOf("");
    EXPECT_TRUE(untried.text.ends_with("; it was not reproduced: no room")) << untried.text;
}

}  // namespace
}  // namespace diptych::tests
