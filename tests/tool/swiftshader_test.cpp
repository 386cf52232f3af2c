// SPDX-License-Identifier: MIT
// The program on a second driver: SwiftShader, a conformant Vulkan 1.3 device on the CPU from Debian's
// chromium-common. Skipped if it is not installed.
#include "tests/support/campaign.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <sstream>
#include <string>
#include <vector>

namespace diptych {
namespace {

const fs::path driverFile = "/usr/lib/chromium/vk_swiftshader_icd.json";

class SwiftShader : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(driverFile))
            GTEST_SKIP() << driverFile << " is not there: install chromium to run on SwiftShader";
    }
    Ran run(const std::string& arguments) const {
        return runShell(folder,
                        "env VK_DRIVER_FILES=" + driverFile.string() + " '" DIPTYCH_PROGRAM "' " + arguments,
                        folder.path());
    }
    Folder folder;
};

TEST_F(SwiftShader, IsTheDeviceAndSaysWhatItLacks) {
    const Ran ran = run("devices --json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "") << "the driver complains of nothing that it was told";
    const auto device = nlohmann::json::parse(ran.out)["devices"][0];
    EXPECT_NE(device["name"].get<std::string>().find("SwiftShader"), std::string::npos);
    for (const auto& property : device["facts"]) {
        const bool snorm = property["what"] == "rounds to nearest: R16G16_SNORM";
        EXPECT_TRUE(!snorm || property["note"].get<std::string>().starts_with("not supported"))
            << property["note"];
    }
}

// A seeded selection of the scenes, always with area lights, skins and blended surfaces.
TEST_F(SwiftShader, BothPathsAgreeOnEveryBuiltinScene) {
    std::istringstream list(run("render --list-scenes").out);
    std::vector<std::string> names;
    for (std::string line; std::getline(list, line);) names.push_back(line.substr(0, line.find(' ')));
    ASSERT_GT(names.size(), 30u);
    const Rows rows(18);
    std::string chosen = isCampaign() ? "" : "builtin:areas builtin:motion builtin:glass ";
    for (int row = 0; row < static_cast<int>(names.size()); row = rows.after(row))
        if (chosen.find(names[static_cast<std::size_t>(row)]) == chosen.npos)
            chosen += "'" + names[static_cast<std::size_t>(row)] + "' ";
    const Ran ran = run("compare " + chosen + "-q --size 32x18 --runs 1 -o r" +
                        (isCampaign() ? "" : " --channels lit,normals,light_count"));
    EXPECT_EQ(ran.code, 0) << chosen << "\n" << ran.out << ran.err;
    EXPECT_EQ(ran.err, "");
}

TEST_F(SwiftShader, BothPathsAgreeUnderShadowsSamplesAndAnEnvironment) {
    ASSERT_EQ(run("render builtin:emission -q --size 64x32 --channels lit --runs 0 -o sky.exr").code, 0);
    for (const char* arguments :
         {"builtin:suns --shadows evsm --shadow-size 256 --msaa 4", "builtin:crossed --transparency weighted",
          "builtin:points --lighting compute --assign tiled --shadows pcf --shadow-lights 2",
          "builtin:normals --env sky.exr --haze on"}) {
        const Ran ran = run(std::string("compare ") + arguments +
                            " -q --size 32x18 --runs 1 --channels lit,normals -o r --force");
        EXPECT_EQ(ran.code, 0) << arguments << "\n" << ran.out << ran.err;
    }
}

TEST_F(SwiftShader, EveryProbeKeepsToWhatVulkanAllows) {
    const Ran ran = run("devices --probe");  // exit code 0: every one passes
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
}

// Beyond 65,536 texels.
TEST_F(SwiftShader, FortyThousandLightsAreRead) {
    const Ran ran =
        run("compare builtin:points --lights point:40000 -q --size 24x14 --runs 1 --channels lit -o r");
    EXPECT_EQ(ran.code, 0) << ran.err;
}

}  // namespace
}  // namespace diptych
