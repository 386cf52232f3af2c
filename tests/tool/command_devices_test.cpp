// SPDX-License-Identifier: MIT
// diptych devices: what it says of each.
#include "tests/tool/run.h"
#include "tests/tool/sweep.h"

#include <set>

namespace diptych {
namespace {

TEST(Command, DevicesListsProperties) {
    const Folder folder;
    const Ran ran = runTool(folder, "devices --json");
    EXPECT_EQ(ran.code, 0) << ran.err;
    const Json json = parsed(ran);
    ASSERT_FALSE(json["devices"].empty());
    for (const Json& device : json["devices"]) {
        EXPECT_FALSE(device["name"].get<std::string>().empty());
        EXPECT_TRUE((std::set<std::string>{"cpu", "discrete", "integrated", "virtual", "other"})
                        .contains(device["type"].get<std::string>()));
        EXPECT_FALSE(device["facts"].empty());
        for (const Json& fact : device["facts"]) {
            const std::string what = fact["what"];
            EXPECT_FALSE(what.starts_with("rounds to nearest: ") && fact["required"] == true) << what;
        }
    }
    EXPECT_NE(runTool(folder, "devices").out.find(json["devices"][0]["name"].get<std::string>()),
              std::string::npos);
}

// Probes the shaders' functions on the device, only on request.
TEST(Command, DevicesProbesThem) {
    const Folder folder;
    const Ran ran = runTool(folder, "devices --device 0 --probe --json");
    EXPECT_EQ(ran.code, 0) << ran.out;
    const Json device = parsed(ran)["devices"][0];
    EXPECT_GT(device["probes"].size(), 50u);
    for (const Json& probe : device["probes"]) {
        EXPECT_EQ(probe["pass"], true) << probe;
        EXPECT_LE(probe["of_limit"]["error"], 1) << probe;
        EXPECT_FALSE(probe["because"].get<std::string>().empty());
    }
    EXPECT_FALSE(parsed(runTool(folder, "devices --device 0 --json"))["devices"][0].contains("probes"));
    EXPECT_EQ(runTool(folder, "plan --probe builtin:triangle").code, 2);
}

TEST(Command, DevicesCanBeLimitedToOne) {
    const Folder folder;
    const Ran ran = runTool(folder, "devices --json --device 0");
    EXPECT_EQ(ran.code, 0) << ran.err;
    ASSERT_EQ(parsed(ran)["devices"].size(), 1u);
    EXPECT_EQ(parsed(ran)["devices"][0]["index"], 0);
}

}  // namespace
}  // namespace diptych
