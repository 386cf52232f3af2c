// SPDX-License-Identifier: MIT
// `diptych calibrate` on Diptych itself, behind a script that misinterprets its job.
#include "tests/tool/fake_renderer.h"

#include <set>

namespace diptych {
namespace {

using Json = nlohmann::json;

const fs::path adapters = fs::path(DIPTYCH_SOURCE_DIR) / "compare" / "external" / "adapters";

// Writes odd.json: a renderer that changes its job by Python statements and passes it on to the template.
void writeOdd(const Folder& folder, const std::string& change, const Json& granted = Json::object()) {
    folder.write("odd.py", "import json, os, sys\njob = json.load(open(sys.argv[-2]))\n" + change +
                               "\nodd = sys.argv[-2] + '.odd'\njson.dump(job, open(odd, 'w'))\n"
                               "os.environ['DIPTYCH'] = '" DIPTYCH_PROGRAM
                               "'\n"
                               "os.execv('" +
                               (adapters / "template.sh").string() + "', ['template.sh', odd, ''])\n");
    folder.write("odd.json",
                 Json{{"command", {"python3", (folder / "odd.py").string()}}, {"granted", granted}}.dump());
}

std::set<std::string> namesIn(const Json& found) {
    std::set<std::string> names;
    for (const Json& one : found["deviations"]) names.insert(one["name"]);
    return names;
}

TEST(Calibrate, WhatIsFoundCanBeGranted) {
    const Folder folder;
    const std::string change =
        "for light in job['lights']: light['intensity'] *= 3.14159265\n"
        "job['camera']['fov_degrees'] -= 1\n"
        "if job['environment']: job['environment']['rotation_degrees'] += 90";
    writeOdd(folder, change);
    Ran ran = runTool(folder, "calibrate odd.json --json -q");
    EXPECT_EQ(ran.code, 1) << ran.err;
    const Json found = Json::parse(ran.out);
    EXPECT_EQ(namesIn(found), (std::set<std::string>{"environment_rotation", "fov", "light_factor"}))
        << ran.out;
    EXPECT_NEAR(found["granted"]["light_factor"].get<double>(), 1 / 3.14159265, 1e-6);
    // With the found corrections the same renderer interprets its job correctly.
    writeOdd(folder, change, found["granted"]);
    ran = runTool(folder, "calibrate odd.json");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_NE(ran.out.find("granted light_factor 0.318"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("pass: it interprets its inputs as Diptych does"), std::string::npos) << ran.out;
}

TEST(Calibrate, ARendererThatDrawsNothingOrFailsIsSaid) {
    const Folder folder;
    writeRenderer(folder, "fake", {"picture"});
    Ran ran = runTool(folder, "calibrate fake.json");
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(ran.out.find("FAIL unrecognised"), std::string::npos) << ran.out;
    writeRenderer(folder, "fake", {"exit"});
    EXPECT_TRUE(runTool(folder, "calibrate fake.json -q").failedOver("exited with 3: no licence"));
    EXPECT_EQ(runTool(folder, "calibrate").code, 2);
}

bool isInstalled(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

TEST(Calibrate, CyclesMeansWhatItIsTold) {
    if (!isInstalled("blender")) GTEST_SKIP() << "NO BLENDER: the adapter of Cycles is not run";
    const Folder folder;
    const Ran ran = runTool(folder, "calibrate '" + (adapters / "cycles.json").string() + "' -q --json");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
}

TEST(Calibrate, ThreeMeansWhatItIsToldButDrawsNoAreaLights) {
    const char* const three = std::getenv("DIPTYCH_THREE");
    if (!three || !isInstalled("chromium") || !isInstalled("node"))
        GTEST_SKIP() << "NO THREE.JS, CHROMIUM OR NODE: the adapter of three.js is not run";
    const Folder folder;
    const Ran ran = runTool(folder, "calibrate '" + (adapters / "three.json").string() + "' -q --json");
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_EQ(namesIn(Json::parse(ran.out)), std::set<std::string>{"no_area_lights"}) << ran.out;
}

}  // namespace
}  // namespace diptych
