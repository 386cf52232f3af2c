// SPDX-License-Identifier: MIT
// Bytes of SPIR-V in the program: spirv_budget.txt has a limit for each module and for all together.
// Limits only go down. A change that needs more says why in its commit and takes it back elsewhere. A limit
// is at most a tenth above its module, so that a smaller module lowers it. This writes the table anew,
// because an empty one fails and prints it:
//     table=tests/unit/architecture/spirv_budget.txt
//     build/tests/unit_tests --gtest_filter=SpirvBudget.E* | grep '^[a-z_.]* [0-9]*$' >$table
#include "compare/probe/modules.h"
#include "shared/vulkan/spirv/spirv.h"
#include "tests/support/files.h"
#include "tests/support/sources.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spirv-tools/libspirv.h>

#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

namespace diptych {
namespace {

// Other versions of spirv-opt give other sizes.
constexpr std::string_view measuredWith = "v2023.1";

using Bytes = std::map<std::string, std::size_t>;  // by file name; "all": of all modules

Bytes embeddedBytes() {
    Bytes bytes;
    for (const auto& all : {shaderModules(), probe::shaderModules()})
        for (const ShaderModule& module : all) {
            EXPECT_FALSE(bytes.contains(std::string(module.name))) << module.name;
            bytes[std::string(module.name)] = module.words.size_bytes();
            bytes["all"] += module.words.size_bytes();
        }
    return bytes;
}

Bytes readBudget() {
    Bytes limits;
    std::istringstream rows(contentsOf(DIPTYCH_SOURCE_DIR "/tests/unit/architecture/spirv_budget.txt"));
    std::size_t limit = 0;
    for (std::string name; rows >> name >> limit;) EXPECT_TRUE(limits.emplace(name, limit).second) << name;
    EXPECT_TRUE(rows.eof());
    return limits;
}

// The limit to write down; a twentieth is left for small changes.
std::size_t limitFor(std::size_t bytes) {
    return (bytes + bytes / 20 + 99) / 100 * 100;
}
// The highest limit: a tenth above, and some instructions for the smallest modules.
std::size_t highestFor(std::size_t bytes) {
    return bytes + bytes / 10 + 200;
}

Faults wrongNames(const Bytes& limits, const Bytes& embedded) {
    Faults faults;
    for (const auto& [name, bytes] : embedded)
        if (!limits.contains(name)) faults.push_back(fmt::format("{}: no limit", name));
    for (const auto& [name, limit] : limits)
        if (!embedded.contains(name)) faults.push_back(fmt::format("{}: a limit of no module", name));
    return faults;
}

Faults wrongLimits(const Bytes& limits, const Bytes& embedded) {
    Faults faults;
    for (const auto& [name, bytes] : embedded) {
        const auto row = limits.find(name);
        if (row == limits.end()) continue;
        if (bytes > row->second)
            faults.push_back(fmt::format("{}: {} bytes, its limit is {}", name, bytes, row->second));
        if (row->second > highestFor(bytes))
            faults.push_back(
                fmt::format("{}: {} bytes, its limit of {} is too high", name, bytes, row->second));
    }
    return faults;
}

// The table that suits these modules.
std::string budgetFor(const Bytes& embedded) {
    std::string rows;
    for (const auto& [name, bytes] : embedded) rows += fmt::format("{} {}\n", name, limitFor(bytes));
    return rows;
}

TEST(SpirvBudget, EveryModuleHasALimit) {
    const Bytes embedded = embeddedBytes();
    EXPECT_EQ(joined(wrongNames(readBudget(), embedded)), "") << budgetFor(embedded);
}

TEST(SpirvBudget, NoModuleIsLargerNorItsLimitMuchHigher) {
    if (!std::string_view(spvSoftwareVersionString()).starts_with(measuredWith))
        GTEST_SKIP() << "the limits are of SPIRV-Tools " << measuredWith << ", this is "
                     << spvSoftwareVersionString();
    const Bytes embedded = embeddedBytes();
    EXPECT_EQ(joined(wrongLimits(readBudget(), embedded)), "") << budgetFor(embedded);
}

TEST(SpirvBudget, WhatIsMissingTooLargeOrTooHighIsNamed) {
    const Bytes embedded{{"a.frag", 100'000}, {"all", 100'900}, {"b.vert", 900}};
    const Bytes right{{"a.frag", 100'000}, {"all", 111'190}, {"b.vert", 1'190}};
    EXPECT_EQ(joined(wrongNames(right, embedded)) + joined(wrongLimits(right, embedded)), "");
    EXPECT_EQ(wrongNames({{"a.frag", 1}, {"all", 1}, {"c.comp", 1}}, embedded),
              (Faults{"b.vert: no limit", "c.comp: a limit of no module"}));
    EXPECT_EQ(wrongLimits({{"a.frag", 99'999}, {"all", 111'191}, {"b.vert", 1'191}}, embedded),
              (Faults{"a.frag: 100000 bytes, its limit is 99999",
                      "all: 100900 bytes, its limit of 111191 is too high",
                      "b.vert: 900 bytes, its limit of 1191 is too high"}));
    for (const std::size_t bytes : {4ul, 648ul, 1'000'000ul}) {
        EXPECT_GE(limitFor(bytes), bytes);
        EXPECT_LE(limitFor(bytes), highestFor(bytes));
    }
}

}  // namespace
}  // namespace diptych
