// SPDX-License-Identifier: MIT
// The program queries every capability before use. For each row of DeviceSupport's tables, a layer hides
// an optional capability. A comparison that uses it must have the same verdict, or end in one line that
// names what lacks and what helps. The validation layer is above this one, and any validation message is a
// failure.
#include "tests/support/campaign.h"
#include "tests/tool/hidden.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace diptych {
namespace {

// A command that uses the rows whose names contain one of `rows`; the last one uses all others.
struct Use {
    std::vector<std::string> rows;
    std::string arguments;
};
const std::vector<Use>& uses() {
    static const std::vector<Use> list{
        {{"SFLOAT blended", "independentBlend"}, "builtin:crossed --transparency weighted"},
        {{"SFLOAT blended", "R32_UINT multisampled", "R32G32_UINT multisampled", "Output"},
         "builtin:crossed --msaa 4"},
        {{"Int64", "geometryShader", "fragmentStores"}, "builtin:crossed --transparency list"},
        {{"shaderInt64", "bufferDeviceAddress"}, "builtin:motion"},
        {{"B10G11R11"}, "builtin:crossed --lit-format b10g11r11"},
        {{"D24"}, "builtin:triangle --depth-format d24"},
        {{"Float16"}, "builtin:points --shading-precision fp16"},
        {{"R16G16B16A16_UNORM"}, "builtin:sixteen_bits builtin:suns --shadows msm4"},
        {{"R32G32_SFLOAT", "R32G32B32A32_SFLOAT filtered", "R32G32B32A32_SFLOAT stored"},
         "builtin:sixteen_bits builtin:suns --shadows evsm4"},
        {{"R16G16_SFLOAT"}, "builtin:suns --shadows evsm --evsm-precision fp16"},
        {{"R16G16B16A16_SFLOAT"}, "builtin:suns --shadows evsm4 --evsm-precision fp16"},
        {{"StorageImage"}, "builtin:points --lighting compute --msaa 4"},
        {{"R32G32B32A32_UINT"}, "builtin:points --gbuffer full --msaa 4"},
        {{"maxTexelBufferElements"}, "builtin:points --lights point:40000"},
        {{}, "builtin:crossed --msaa 4 --shadows pcf"},
    };
    return list;
}

std::vector<std::string> usesOf(const std::string& row) {
    std::vector<std::string> arguments;
    for (const Use& use : uses())
        if (std::ranges::any_of(use.rows,
                                [&](const std::string& name) { return row.find(name) != row.npos; }))
            arguments.push_back(use.arguments);
    if (arguments.empty()) arguments.push_back(uses().back().arguments);
    return arguments;
}

std::string compared(const std::string& arguments) {
    return "compare " + arguments +
           " -q -o r --force --size 32x18 --runs 1 --channels lit,normals --validate";
}

std::string verdictIn(const Folder& folder) {
    const auto report = nlohmann::json::parse(contentsOf(folder / "r" / "report.json"), nullptr, false);
    return report.is_discarded() ? "none" : report.value("verdict", "none");
}

TEST(HiddenSupport, ACompareHasTheSameVerdictOrNamesWhatLacks) {
    const std::vector<std::string> all = everythingToHide();
    ASSERT_GT(all.size(), 60u);
    std::map<std::string, std::string> verdicts;  // with nothing hidden, by arguments
    const Rows rows(18);
    int same = 0, named = 0;
    const Folder folder;
    for (int row = 0; row < static_cast<int>(all.size()); row = rows.after(row)) {
        const std::string& hidden = all[static_cast<std::size_t>(row)];
        const std::vector<std::string> arguments = usesOf(hidden);
        for (const std::string& use : arguments) {
            SCOPED_TRACE(hidden + ": " + use);
            if (!verdicts.contains(use)) {
                const Ran standard = runHiding(folder, "", compared(use));
                EXPECT_LE(standard.code, 1) << standard.err;
                verdicts[use] = verdictIn(folder);
            }
            fs::remove_all(folder / "r");
            const Ran ran = runHiding(folder, hidden, compared(use));
            if (ran.code == 2) {
                ++named;
                EXPECT_TRUE(ran.failedOver("")) << ran.err;
                EXPECT_TRUE(std::regex_search(
                    ran.err,
                    std::regex("lacks|has no|cannot|needs|does not support|reads up to|up to|limit")))
                    << ran.err;
                EXPECT_TRUE(std::regex_search(ran.err, std::regex("use --|another")))
                    << "what helps is not said: " << ran.err;
                EXPECT_EQ(ran.err.find("alidation"), std::string::npos) << ran.err;
            } else {
                ++same;
                EXPECT_EQ(ran.err, "");
                EXPECT_EQ(verdictIn(folder), verdicts[use]) << ran.err;
            }
        }
    }
    EXPECT_GT(same + named, 0);
    if (isCampaign()) {
        EXPECT_GT(same, 0);
        EXPECT_GT(named, 0);
    }
    RecordProperty("same", same);
    RecordProperty("named", named);
}

// Negative control: the program does not query limits below Vulkan's required minimum, so the validation
// layer reports them.
TEST(HiddenSupport, WhatIsUsedWithoutAskingIsAValidationMessage) {
    const Folder folder;
    const Ran ran = runHiding(folder, "limit maxPushConstantsSize 16", compared("builtin:triangle"));
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("VUID-VkPushConstantRange"), std::string::npos) << ran.err;
}

TEST(HiddenSupport, ARequiredFeatureThatLacksIsNamedAndAnotherDeviceOffered) {
    const Folder folder;
#define DIPTYCH_REQUIRED(version, name, need, what)                                                      \
    if (std::string(#need) == "required" && (isCampaign() || std::string(#name) == "dynamicRendering" || \
                                             std::string(#name) == "fullDrawIndexUint32")) {             \
        const Ran ran = runHiding(folder, "feature " #name, compared("builtin:triangle"));               \
        EXPECT_TRUE(ran.failedOver(std::string("lacks ") + (what) + "; choose another with --device"))   \
            << ran.err;                                                                                  \
        EXPECT_FALSE(fs::exists(folder / "r"));                                                          \
        EXPECT_NE(runHiding(folder, "feature " #name, "devices").out.find(what), std::string::npos);     \
    }
    DEVICE_FEATURES(DIPTYCH_REQUIRED)
#undef DIPTYCH_REQUIRED
}

// The table of roundings says so, and no Vulkan call uses the format.
TEST(HiddenSupport, AProbeOfWhatADeviceLacksSaysNotSupported) {
    const Folder folder;
    const Ran ran = runHiding(folder, "format R16G16_SNORM drawn", "devices --validate --json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    bool found = false;
    const auto properties = nlohmann::json::parse(ran.out)["devices"][0]["facts"];
    for (const auto& property : properties)
        if (property["what"] == "rounds to nearest: R16G16_SNORM") {
            found = true;
            EXPECT_EQ(property["there"], false);
            EXPECT_TRUE(property["note"].get<std::string>().starts_with("not supported")) << property["note"];
        }
    EXPECT_TRUE(found);
}

// Lights beyond a texel buffer's capacity are read through buffer addresses: same bits, for every light
// type and culling method. Vulkan guarantees 65,536 texels; a lower limit gives the same situation with
// few lights.
TEST(HiddenSupport, LightsBeyondATexelBufferGiveTheSameBits) {
    struct Case {
        std::string texels, arguments;
    };
    std::vector<Case> cases{{"65536", "--lights point:20000,spot:20500 --assign clustered --path deferred"}};
    for (const char* way :
         {"every --path deferred", "tiled --path deferred", "clustered --path forward_plus"})
        cases.push_back({"2048", std::string("--lights point:500,spot:500,area:60 --assign ") + way});
    for (const Case& c : cases) {
        SCOPED_TRACE(c.arguments);
        const Folder folder;
        const std::string render =
            "render builtin:points -q --size 24x14 --channels lit --runs 0 --validate " + c.arguments +
            " -o ";
        const Ran standard = runHiding(folder, "", render + "a.exr"),
                  hiding = runHiding(folder, "limit maxTexelBufferElements " + c.texels, render + "b.exr");
        ASSERT_EQ(standard.code, 0) << standard.err;
        ASSERT_EQ(hiding.code, 0) << hiding.err;
        EXPECT_TRUE(contentsOf(folder / "a.exr") == contentsOf(folder / "b.exr"));
    }
}

}  // namespace
}  // namespace diptych
