// SPDX-License-Identifier: MIT
// three.js in headless Chromium compared with ours, if both are installed.
#include "tests/tool/browser.h"

namespace diptych {
namespace {

using Json = nlohmann::json;

const fs::path assets = fs::path(DIPTYCH_SOURCE_DIR) / ".." / "shared" / "assets" / "scenes";
const fs::path adapters = fs::path(DIPTYCH_SOURCE_DIR) / "compare" / "external" / "adapters";

// Why three.js cannot run; empty if it can.
std::string lackingForThree() {
    const char* const folder = std::getenv("DIPTYCH_THREE");
    if (!folder || !fs::exists(fs::path(folder) / "node_modules/three"))
        return "NO THREE.JS: DIPTYCH_THREE names no folder with node_modules/three, its adapter is not run";
    if (browser().empty()) return "NO CHROMIUM: three.js is not run";
    if (std::system("command -v node >/dev/null 2>&1") != 0) return "NO NODE: three.js is not run";
    return {};
}

// Mean FLIP between three.js and forward+ over the whole image, by diff; and the notes on omissions.
struct AgainstThree {
    double flip = 1;
    std::string notes;
};
AgainstThree againstThree(const Folder& folder, const std::string& scene, const std::string& more,
                          const Json& granted = Json::object()) {
    folder.write(
        "three.json",
        Json{{"command", {"node", (adapters / "three.mjs").string()}}, {"timeout", 300}, {"granted", granted}}
            .dump());
    folder.write("t.json", R"({"rules": [{"channel": "lit", "flip": 1, "because": "measured here"}]})");
    const Ran ran = runTool(folder, "compare '" + scene + "' " + more +
                                        " --size 320x180 --runs 0 --channels lit -q --baseline forward_plus "
                                        "--tolerances t.json --renderer three=three.json");
    EXPECT_EQ(ran.code, 0) << ran.err;
    const Json report = Json::parse(contentsOf(folder / "diptych-report/report.json"));
    const Ran diff = runTool(folder,
                             "diff diptych-report/forward_plus.exr diptych-report/three.exr --channels lit "
                             "--tolerance 1 --json");
    EXPECT_EQ(diff.code, 0) << diff.err;
    const double flip = Json::parse(diff.out)["metrics"]["flip"];
    std::printf("%s %s: FLIP %.4f\n", fs::path(scene).filename().c_str(), more.c_str(), flip);
    return {flip, report["frames"].back()["notes"].dump()};
}

TEST(Three, ABoxAndPunctualLightsAgree) {
    if (const std::string lacking = lackingForThree(); !lacking.empty()) GTEST_SKIP() << lacking;
    const fs::path box = assets / "features/box/Box.glb";
    if (!fs::exists(box)) GTEST_SKIP() << "NO ASSETS at " << assets;
    const Folder folder;
    // three.js models multiple scattering for suns (--multiscatter); it renders no shadows here.
    EXPECT_LT(againstThree(folder, box.string(), "--shadows off --multiscatter energy").flip, 0.01);
    const fs::path lights = assets / "features/lights_punctual/Lights.glb";
    EXPECT_LT(againstThree(folder, lights.string(), "--shadows off").flip, 0.01);
    // Added lights are part of the job. Control: different lights are detected.
    const std::string rig = "--shadows off --seed 3 --lights point:4";
    EXPECT_LT(againstThree(folder, lights.string(), rig).flip, 0.01);
    EXPECT_GT(againstThree(folder, lights.string(), rig, {{"light_factor", 2}}).flip, 0.01);
}

// Conventions in which three.js differs from glTF, or that glTF leaves open (shared/material/README.md).
const std::string conventions =
    "--shadows off --multiscatter energy --base-layer component --spot-cone smoothstep --range-window "
    "squared "
    "--spec-aa on --spec-aa-kernel slope";

TEST(Three, AgreesUnderItsConventions) {
    if (const std::string lacking = lackingForThree(); !lacking.empty()) GTEST_SKIP() << lacking;
    if (!fs::exists(assets)) GTEST_SKIP() << "NO ASSETS at " << assets;
    const Folder folder;
    for (const std::string& scene :
         {(assets / "features/box/Box.glb").string(), (assets / "pbr_spheres/PBR_Spheres.glb").string(),
          (assets / "flight_helmet/FlightHelmet.gltf").string(),
          (assets / "features/lights_punctual/Lights.glb").string(), std::string("builtin:points"),
          std::string("builtin:spots")}) {
        EXPECT_LT(againstThree(folder, scene, conventions).flip, 0.01) << scene;
    }
}

// Causes that `explain` names for three.js's difference under glTF's own conventions.
std::string namedOf(const Folder& folder, const std::string& scene) {
    const Ran ran = runTool(folder, "explain '" + scene +
                                        "' --size 320x180 --shadows off --baseline forward_plus --json "
                                        "--renderer three='" +
                                        (adapters / "three.json").string() + "'");
    EXPECT_EQ(ran.code, 0) << ran.err;
    std::string names;
    const Json found = Json::parse(ran.out);
    for (const Json& cause : found["causes"]) names += cause["name"].get<std::string>() + " ";
    return names;
}

TEST(Three, ExplainNamesEachOfItsConventions) {
    if (const std::string lacking = lackingForThree(); !lacking.empty()) GTEST_SKIP() << lacking;
    const Folder folder;
    const std::string spots = namedOf(folder, "builtin:spots");
    EXPECT_NE(spots.find("--spot-cone"), std::string::npos) << spots;
    EXPECT_NE(spots.find("--range-window"), std::string::npos) << spots;
    const std::string tinted = namedOf(folder, "builtin:dielectrics");
    EXPECT_NE(tinted.find("--base-layer"), std::string::npos) << tinted;
    EXPECT_NE(tinted.find("roughness"), std::string::npos) << tinted;
    if (!fs::exists(assets)) GTEST_SKIP() << "NO ASSETS at " << assets;
    const std::string spheres = namedOf(folder, (assets / "pbr_spheres/PBR_Spheres.glb").string());
    EXPECT_NE(spheres.find("--multiscatter"), std::string::npos) << spheres;
    EXPECT_NE(spheres.find("roughness"), std::string::npos) << spheres;
}

TEST(Three, WhatItCannotDrawIsSaid) {
    if (const std::string lacking = lackingForThree(); !lacking.empty()) GTEST_SKIP() << lacking;
    const Folder folder;
    const AgainstThree areas = againstThree(folder, "builtin:areas", "");
    EXPECT_NE(areas.notes.find("left out: "), std::string::npos) << areas.notes;
    EXPECT_NE(areas.notes.find("rect lights"), std::string::npos) << areas.notes;
}

}  // namespace
}  // namespace diptych
