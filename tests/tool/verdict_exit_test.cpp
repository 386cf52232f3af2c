// SPDX-License-Identifier: MIT
// Warnings, bounds met exactly, and FLIP's options, as scripts see them: exit codes and numbers.
#include "compare/metrics/flip.h"
#include "shared/image/image_file.h"
#include "shared/image/pfm.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

namespace diptych {
namespace {

using Json = nlohmann::json;

// Errors of 0, and of 0.25 at one pixel: exact in binary.
void writePair(const Folder& folder) {
    Image a(16, 8, 3, 0.5f), b = a;
    for (int c = 0; c < 3; ++c) b.at(3, 5, c) = 0.75f;
    writePfm(folder / "a.pfm", a);
    writePfm(folder / "b.pfm", b);
}

TEST(VerdictExit, ABoundItselfPasses) {
    const Folder folder;
    writePair(folder);
    const std::string max = "diff a.pfm b.pfm -q --metric max --tolerance ";
    EXPECT_EQ(runTool(folder, max + "0.25").code, 0);
    EXPECT_EQ(runTool(folder, max + "0.24999999").code, 1);
    EXPECT_EQ(runTool(folder, "diff a.pfm a.pfm -q --metric max --tolerance 0").code, 0);
    // A fraction: one of 128 pixels is beyond 0.2, none beyond 0.25.
    const std::string fraction = "diff a.pfm b.pfm -q --failing 0.0078125 --tolerance ";
    EXPECT_EQ(runTool(folder, fraction + "0.2").code, 0) << "1 / 128 itself";
    EXPECT_EQ(runTool(folder, "diff a.pfm b.pfm -q --failing 0.0078 --tolerance 0.2").code, 1);
    EXPECT_EQ(runTool(folder, "diff a.pfm b.pfm -q --failing 0 --tolerance 0.25").code, 0);
}

// A warning is reported everywhere and fails nothing.
TEST(VerdictExit, AWarningIsNoFailure) {
    const Folder folder;
    writePair(folder);
    const std::string warned = "diff a.pfm b.pfm --metric max --tolerance 0.3 --warn ";
    Ran ran = runTool(folder, warned + "0.25");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out.find("warn"), std::string::npos) << "the bound itself does not warn: " << ran.out;
    ran = runTool(folder, warned + "0.2 -o report");
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_NE(ran.out.find("warning a.pfm, lit: max 0.25 exceeds 0.2"), std::string::npos) << ran.out;
    const Json channel =
        Json::parse(contentsOf(folder / "report/report.json"))["comparisons"][0]["channels"][0];
    EXPECT_EQ(channel["verdict"], "pass");
    EXPECT_EQ(channel["warning"], "max 0.25 exceeds 0.2, at 0.781 % of the pixels");
    const std::string junit = contentsOf(folder / "report/junit.xml");
    EXPECT_NE(junit.find("failures=\"0\""), std::string::npos);
    EXPECT_EQ(junit.find("<failure"), std::string::npos);
    EXPECT_EQ(runTool(folder, "diff a.pfm b.pfm -q --metric max --tolerance 0.1 --warn 0.05").code, 1)
        << "beyond both it fails";
    ran = runTool(folder, warned + "0.2 --json");
    EXPECT_EQ(Json::parse(ran.out)["verdict"], "pass");
}

// The metric uses the requested pixels per degree and exposures.
TEST(VerdictExit, FlipsOptionsReachIt) {
    const Folder folder;
    writePair(folder);
    const Image a = readImage(folder / "a.pfm").layers.at(0).image,
                b = readImage(folder / "b.pfm").layers.at(0).image;
    const auto flipOf = [&](const std::string& options) {
        const Ran ran = runTool(folder, "diff a.pfm b.pfm --json " + options);
        return Json::parse(ran.out)["metrics"]["flip"].get<double>();
    };
    HdrFlipOptions flip;
    EXPECT_DOUBLE_EQ(flipOf(""), hdrFlip(a, b, flip).mean);
    EXPECT_DOUBLE_EQ(flipOf("--ppd 67.0206"), hdrFlip(a, b, flip).mean) << "the default";
    flip.pixels_per_degree = 20;
    EXPECT_DOUBLE_EQ(flipOf("--ppd 20"), hdrFlip(a, b, flip).mean);
    EXPECT_NE(flipOf("--ppd 20"), flipOf(""));
    flip.start_exposure = -1;
    flip.stop_exposure = 2;
    flip.exposures = 3;
    EXPECT_DOUBLE_EQ(flipOf("--ppd 20 --start-exposure=-1 --stop-exposure 2 --exposures 3"),
                     hdrFlip(a, b, flip).mean);
}

}  // namespace
}  // namespace diptych
