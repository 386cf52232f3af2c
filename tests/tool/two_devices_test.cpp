// SPDX-License-Identifier: MIT
// compare and explain --against-device: lavapipe against itself everywhere, and against SwiftShader
// (Debian's chromium-common) if it is installed.
#include "tests/support/campaign.h"
#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <string>

namespace diptych {
namespace {

using Json = nlohmann::json;

const fs::path otherDriver = "/usr/lib/chromium/vk_swiftshader_icd.json",
               ownDriver = "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json";

// Both drivers in one process.
Ran runOnBoth(const Folder& folder, const std::string& arguments) {
    return runShell(folder,
                    "env VK_DRIVER_FILES=" + ownDriver.string() + ":" + otherDriver.string() +
                        " '" DIPTYCH_PROGRAM "' " + arguments,
                    folder.path());
}

Json reportIn(const Folder& folder) {
    return Json::parse(contentsOf(folder / "r/report.json"));
}

TEST(AgainstDevice, ADeviceDoesNotDifferFromItself) {
    const Folder folder;
    const Ran ran = runTool(
        folder, "compare builtin:triangle -q --device 0 --against-device 0 --size 48x27 --runs 0 -o r");
    ASSERT_EQ(ran.code, 0) << ran.out << ran.err;
    const Json report = reportIn(folder);
    EXPECT_EQ(report["against_device"]["name"], report["device"]["name"]);
    ASSERT_EQ(report["comparisons"].size(), 4u);
    for (const std::size_t pair : {1, 2})
        for (const Json& channel : report["comparisons"][pair]["channels"])
            EXPECT_EQ(channel["max"], 0) << channel["name"];
    EXPECT_EQ(report["comparisons"][1]["baseline"], "deferred");
    EXPECT_EQ(report["comparisons"][2]["baseline"], "forward_plus");
    for (const char* file : {"r/deferred.exr", "r/forward_plus.exr", "r/index.html", "r/junit.xml"})
        EXPECT_TRUE(fs::exists(folder / file)) << file;
}

TEST(AgainstDevice, WhatItIsNotComparedWithIsRefused) {
    const Folder folder;
    for (const char* more : {"--baseline reference", "--msaa 4", "--pixel 3,3"})
        EXPECT_TRUE(runTool(folder, std::string("compare builtin:triangle --against-device 0 ") + more)
                        .failedOver("--against-device 0"))
            << more;
    EXPECT_TRUE(runTool(folder, "compare builtin:triangle --against-device nothing").failedOver("nothing"));
}

TEST(AgainstDevice, SwiftShaderDrawsWhatItMay) {
    if (!fs::exists(otherDriver) || !fs::exists(ownDriver))
        GTEST_SKIP() << otherDriver << " is not there: install chromium to compare two devices";
    const Folder folder;
    const Ran ran = runOnBoth(folder,
                              "compare builtin:coplanar builtin:glass builtin:motion -q --device "
                              "llvmpipe --against-device SwiftShader --size 96x54 --runs 0 -o r");
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    const Json report = reportIn(folder);
    EXPECT_NE(report["device"]["name"].get<std::string>().find("llvmpipe"), std::string::npos);
    EXPECT_NE(report["against_device"]["name"].get<std::string>().find("SwiftShader"), std::string::npos);
    std::size_t there = 0;
    for (const Json& frame : report["frames"])
        there += frame["drawn_on"].get<std::string>().find("SwiftShader") != std::string::npos ? 1 : 0;
    EXPECT_EQ(there, report["frames"].size() / 2);
    // Bounds far above every error would prove little.
    double max = 0;
    for (const Json& comparison : report["comparisons"])
        for (const Json& channel : comparison["channels"])
            if (channel.contains("across_devices") && channel["name"] == "depth")
                max = std::max(max, channel["across_devices"]["used"].get<double>());
    EXPECT_GT(max, 0.1);
    EXPECT_NE(contentsOf(folder / "r/index.html").find("SwiftShader"), std::string::npos);
    EXPECT_NE(contentsOf(folder / "r/junit.xml").find("test_device"), std::string::npos);
}

// At 640x360 pixels cross small seams of texture coordinates in a pedestal's top. At 320x180 a shadow ends
// between both devices' positions of a pixel.
TEST(AgainstDevice, SwiftShaderDrawsTheGalleryAtUsualSizes) {
    if (!fs::exists(otherDriver) || !fs::exists(ownDriver))
        GTEST_SKIP() << otherDriver << " is not there: install chromium to compare two devices";
    for (const char* size : {"640x360", "320x180"}) {
        if (size != std::string("640x360") && !isCampaign()) continue;
        const Folder folder;
        const Ran ran = runOnBoth(folder, std::string("compare builtin:gallery -q --device llvmpipe "
                                                      "--against-device SwiftShader --channels lit --runs 0 "
                                                      "--keep none -o r --size ") +
                                              size);
        EXPECT_EQ(ran.code, 0) << size << "\n" << ran.out << ran.err;
    }
}

TEST(AgainstDevice, AnExplanationSaysWhereItComesFrom) {
    if (!fs::exists(otherDriver) || !fs::exists(ownDriver))
        GTEST_SKIP() << otherDriver << " is not there: install chromium to compare two devices";
    const Folder folder;
    const Ran ran = runOnBoth(folder,
                              "explain builtin:cutout --json --device llvmpipe --against-device SwiftShader "
                              "--baseline forward_plus --size 64x36");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json explanation = Json::parse(ran.out);
    double sum = 0;
    for (const Json& part : explanation["devices"]) sum += part["share"].get<double>();
    EXPECT_NEAR(sum, 1, 1e-3);
    EXPECT_LT(explanation["unexplained"].get<double>(), 1e-3);
}

}  // namespace
}  // namespace diptych
