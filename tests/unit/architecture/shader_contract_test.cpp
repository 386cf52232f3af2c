// SPDX-License-Identifier: MIT
// Compares the tables of shared/contract with the embedded modules: the features each pass reads and the
// descriptors its shaders declare. Each check has a negative control: a table with an injected fault.
#include "shared/contract/bindings.h"
#include "shared/contract/gbuffer.h"
#include "shared/contract/light.h"
#include "shared/contract/light_list.h"
#include "shared/contract/material.h"
#include "shared/draw/packed_view.h"
#include "shared/vulkan/spirv/shader_interface.h"
#include "shared/vulkan/spirv/spirv.h"
#include "shared/vulkan/spirv/variant.h"
#include "tests/support/sources.h"
#include "tests/support/spirv_module.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace diptych {
namespace {

// Properties of each embedded module, read once.
struct ReadModule {
    std::string_view name;
    std::set<std::uint32_t> features;
    std::vector<SpirvModule::Binding> bindings;
};
const std::vector<ReadModule>& readModules() {
    static const std::vector<ReadModule> all = [] {
        std::vector<ReadModule> read;
        for (const ShaderModule& embedded : shaderModules()) {
            const SpirvModule module(embedded.words);
            read.push_back({embedded.name, module.usedConstants(), module.bindings()});
        }
        return read;
    }();
    return all;
}

// Passes that use a module, by its name's prefix; none if the module draws no image.
struct ModuleKind {
    std::string_view prefix;
    gpu::uint passes;
};
constexpr ModuleKind moduleKinds[] = {
    {"depth.vert", gpu::PASS_DEPTH},
    {"depth_mask.frag", gpu::PASS_DEPTH},
    {"surface.vert", gpu::PASS_DEPTH | gpu::PASS_FORWARD | gpu::PASS_GBUFFER},
    {"forward_", gpu::PASS_FORWARD},
    {"gbuffer", gpu::PASS_GBUFFER},
    {"background.frag", gpu::PASS_BACKGROUND},
    {"backdrop.frag", gpu::PASS_FORWARD},
    {"transparency_", gpu::PASS_FORWARD},
    {"compose_", gpu::PASS_FORWARD},
    {"deferred_", gpu::PASS_LIGHTING},
    {"sample_", gpu::PASS_SAMPLES},
    {"light_list_", gpu::PASS_LISTS},
    {"cull_lights_", gpu::PASS_LISTS},
    {"shadow_", gpu::PASS_SHADOWS},
    {"pose.comp", gpu::PASS_POSING},
    {"pose_", gpu::PASS_POSING},
    {"clipmap_", 0},
    {"cull_meshlets.comp", 0},
    {"full_screen.vert", 0},
    {"layout.comp", 0},
    {"probe_", 0},
};
const ModuleKind* kindOf(std::string_view module) {
    const auto found = std::ranges::find_if(
        moduleKinds, [&](const ModuleKind& kind) { return module.starts_with(kind.prefix); });
    return found == std::end(moduleKinds) ? nullptr : found;
}

TEST(ShaderContract, EveryModuleBelongsToAPassOrToNone) {
    ASSERT_GT(shaderModules().size(), 50u);
    for (const ShaderModule& module : shaderModules()) {
        EXPECT_NE(kindOf(module.name), nullptr) << module.name;
        EXPECT_FALSE(module.words.empty()) << module.name;
    }
}

// The build sorts the enumeration and the table of modules separately.
TEST(ShaderContract, ModulesAreFoundByShader) {
    EXPECT_EQ(shaderModule(Shader::gbuffer_frag).name, "gbuffer.frag");
    EXPECT_EQ(shaderModule(Shader::surface_vert).name, "surface.vert");
    EXPECT_EQ(shaderModule(Shader::deferred_shade_comp).name, "deferred_shade.comp");
    EXPECT_EQ(shaderModule(Shader::deferred_shade_frag).name, "deferred_shade.frag");
    EXPECT_EQ(&shaderModule(Shader::transparency_moments_frag), &shaderModules().back());
    EXPECT_THROW(shaderModule(Shader::none), std::logic_error);
}

// Locations between shader stages, over all modules. Variants of a module use a subset of its locations.
std::set<std::uint32_t> locationsBetweenStages() {
    std::set<std::uint32_t> found;
    for (const ShaderModule& module : shaderModules()) {
        if (module.name.ends_with(".vert"))
            for (const auto& [variable, locations] : outputsOf(module.words))
                found.insert(locations.begin(), locations.end());
        if (module.name.ends_with(".frag")) found.merge(inputLocations(module.words));
    }
    return found;
}

// Vulkan 1.3, "Required Limits": maxVertexOutputComponents and maxFragmentInputComponents are at least 64,
// and a location has four.
TEST(ShaderContract, EveryDeviceHasTheLocationsBetweenStages) {
    const std::set<std::uint32_t> found = locationsBetweenStages();
    EXPECT_GE(found.size(), 10u) << "the texture coordinates of all slots";
    EXPECT_LT(*found.rbegin(), 64u / 4);
}

struct PassName {
    gpu::uint pass;
    std::string_view name;
};
constexpr PassName passNames[] = {{gpu::PASS_DEPTH, "depth"},       {gpu::PASS_FORWARD, "forward"},
                                  {gpu::PASS_GBUFFER, "G-buffer"},  {gpu::PASS_LIGHTING, "deferred lighting"},
                                  {gpu::PASS_LISTS, "light lists"}, {gpu::PASS_SHADOWS, "shadow maps"},
                                  {gpu::PASS_POSING, "posing"},     {gpu::PASS_SAMPLES, "samples"}};

// Alpha-masked materials' depth pass shares surface.vert with shading passes. Outputs that depend on
// shading features do not matter there: depth_mask.frag does not read them.
bool unreadOutput(gpu::uint pass, std::string_view module, gpu::uint feature) {
    return pass == gpu::PASS_DEPTH && module.starts_with("surface.vert") &&
           (feature == gpu::FEATURE_object_lights || feature == gpu::FEATURE_double_sided ||
            feature == gpu::FEATURE_smooth_cones || feature == gpu::FEATURE_squared_window ||
            feature == gpu::FEATURE_addressed_lights);
}

// Features that a module of a pass uses but the table lacks, and features that the table assigns to a pass
// without a module that uses them.
Faults wrongReaders(const std::function<gpu::uint(const FeatureRow&)>& passesOf) {
    Faults faults;
    for (const auto& [pass, name] : passNames) {
        std::set<gpu::uint> read;
        for (const ReadModule& module : readModules()) {
            const ModuleKind* kind = kindOf(module.name);
            if (!kind || (kind->passes & pass) == 0) continue;
            for (const std::uint32_t feature : module.features)
                if (!unreadOutput(pass, module.name, feature)) read.insert(feature);
        }
        for (const FeatureRow& row : featureRows) {
            const bool stated = (passesOf(row) & pass) != 0, used = read.contains(row.id);
            if (used && !stated)
                faults.push_back(
                    fmt::format("{} is read by the {} pass, FEATURES does not say so", row.name, name));
            if (stated && !used)
                faults.push_back(
                    fmt::format("{} is not read by the {} pass, FEATURES says so", row.name, name));
        }
    }
    return faults;
}

TEST(ShaderContract, FeaturesAreReadByThePassesThatTheTableNames) {
    EXPECT_EQ(joined(wrongReaders([](const FeatureRow& row) { return row.passes; })), "");
}

TEST(ShaderContract, AForgottenReaderOfAFeatureIsFound) {
    for (const auto& [feature, pass] : {std::pair(gpu::FEATURE_alpha_mask, gpu::PASS_DEPTH),
                                        std::pair(gpu::FEATURE_ambient, gpu::PASS_FORWARD),
                                        std::pair(gpu::FEATURE_lightmap, gpu::PASS_GBUFFER),
                                        std::pair(gpu::FEATURE_spot_lights, gpu::PASS_LISTS),
                                        std::pair(gpu::FEATURE_posed_parts, gpu::PASS_POSING),
                                        std::pair(gpu::FEATURE_captures, gpu::PASS_LIGHTING)}) {
        // Removing a feature's reader is one fault; adding a reader to another feature is one fault.
        const auto without = [&](const FeatureRow& row) {
            return row.id == feature ? row.passes & ~pass : row.passes;
        };
        EXPECT_EQ(wrongReaders(without).size(), 1u) << feature;
    }
    EXPECT_EQ(wrongReaders([](const FeatureRow& row) {
                  return row.id == gpu::FEATURE_encoded_surface ? row.passes | gpu::PASS_LISTS : row.passes;
              }),
              (Faults{"encoded_surface is not read by the light lists pass, FEATURES says so"}));
}

TEST(ShaderContract, MasksAreTheColumnsOfTheTable) {
    constexpr FeatureMask depth = featuresReadBy(gpu::PASS_DEPTH), item = featuresSetBy(FeatureSource::item);
    static_assert(depth.has(gpu::FEATURE_alpha_mask) && !depth.has(gpu::FEATURE_ambient));
    static_assert(item.has(gpu::FEATURE_unlit) && !item.has(gpu::FEATURE_captured));
    static_assert((depth & item).with(gpu::FEATURE_samples) == depth,
                  "a depth pass depends on the item and a pixel's samples alone");
    gpu::uint next = 0;
    for (const FeatureRow& row : featureRows) EXPECT_EQ(row.id, next++) << row.name;
    Variant all;
    for (gpu::uint i = 0; i < gpu::FEATURE_COUNT; ++i) all.set(i, i + 1);
    const Variant some = all.only(depth);
    for (gpu::uint i = 0; i < gpu::FEATURE_COUNT; ++i) EXPECT_EQ(some.get(i), depth.has(i) ? i + 1 : 0u);
    EXPECT_EQ(Variant().take(all, depth), some);
    EXPECT_TRUE(some.any(depth));
    EXPECT_FALSE(some.any(featuresSetBy(FeatureSource::pass)));
}

// A row of a binding table.
using Kind = SpirvModule::Kind;
struct Declared {
    std::string name;
    std::uint32_t set, number;
    Kind kind;
    bool kernels;  // for the compute shaders that build light lists, with their own set 1
};

std::vector<Declared> bindingTables() {
    std::vector<Declared> rows;
    const auto add = [&](gpu::uint set, bool kernels) {
        return [&rows, set, kernels](const char* name, std::uint32_t number, Kind kind) {
            rows.push_back({name, set, number, kind, kernels});
        };
    };
#define ROW(number, name, kind, what) table(#name, number, Kind::kind);
    {
        const auto table = add(gpu::SET_FRAME, false);
        FRAME_BINDINGS(ROW)
    }
    {
        const auto table = add(gpu::SET_PARTIAL_SUMS, false);
        PARTIAL_SUM_BINDINGS(ROW)
    }
    {
        const auto table = add(gpu::SET_GBUFFER, false);
        GBUFFER_SET_BINDINGS(ROW)
    }
    {
        const auto table = add(gpu::SET_LISTS, true);
        LIST_BINDINGS(ROW)
    }
#undef ROW
    const auto table = add(gpu::SET_MATERIAL, false);
#define SLOT(number, name, ...) table(#name, number, Kind::image);
    MATERIAL_SLOTS(SLOT)
#undef SLOT
    table("MATERIAL", gpu::BINDING_MATERIAL, Kind::uniform_buffer);
    return rows;
}

// Descriptors that a module of a pass declares but no row has, or with another type; and rows that no
// module declares.
Faults wrongBindings(const std::vector<Declared>& rows) {
    Faults faults;
    std::set<std::string> declared;
    for (const ReadModule& module : readModules()) {
        const ModuleKind* kind = kindOf(module.name);
        // Compute shaders of shadow maps have their own sets: MOMENT_BINDINGS and DEPTH_BOUNDS_BINDINGS.
        if (!kind || kind->passes == 0 || kind->passes == gpu::PASS_SHADOWS) continue;
        const bool kernel = (kind->passes & gpu::PASS_LISTS) != 0;
        for (const SpirvModule::Binding& binding : module.bindings) {
            const auto row = std::ranges::find_if(rows, [&](const Declared& r) {
                return r.set == binding.set && r.number == binding.number &&
                       (r.set != gpu::SET_LISTS || r.kernels == kernel);
            });
            if (row == rows.end())
                faults.push_back(fmt::format("{}: set {} binding {} is in no table", module.name, binding.set,
                                             binding.number));
            else if (row->kind != binding.kind)
                faults.push_back(
                    fmt::format("{}: {} is of another kind in its table", module.name, row->name));
            else
                declared.insert(row->name);
        }
    }
    for (const Declared& row : rows)
        if (!declared.contains(row.name))
            faults.push_back(row.name + " is declared by no shader of its kind");
    return faults;
}

TEST(ShaderContract, ShadersDeclareTheDescriptorsOfTheTables) {
    EXPECT_EQ(bindingTables().size(), 21u + 5 + 14 + 5 + 4 + 8 + 1 + 13 + 21);
    EXPECT_EQ(joined(wrongBindings(bindingTables())), "");
}

TEST(ShaderContract, AWrongRowOfABindingTableIsFound) {
    const std::vector<Declared> right = bindingTables();
    for (std::size_t i = 0; i < right.size(); ++i) {
        std::vector<Declared> wrong = right;
        wrong[i].kind = right[i].kind == Kind::image ? Kind::texel_buffer : Kind::image;
        EXPECT_FALSE(wrongBindings(wrong).empty()) << right[i].name;
    }
    for (const std::size_t i : {std::size_t{2}, right.size() - 1}) {
        std::vector<Declared> moved = right;
        moved[i].number = 40;
        EXPECT_FALSE(wrongBindings(moved).empty()) << right[i].name;
    }
}

// PACKED_VIEW and PACKED_GRID: C++ and shaders pack and unpack by the same table.
TEST(ShaderContract, ThePackedViewHoldsEveryField) {
    gpu::View view{};
    gpu::LightGrid grid{};
    float number = 1.5f;
    gpu::uint count = 100;
#define FILL_FLOAT(texel, lane, member) of.member = number++;
#define FILL_UINT(texel, lane, member) of.member = count++;
#define FILL_SHORTS(texel, lane, low, high) of.low = count++, of.high = count++;
#define FILL_BYTES(texel, lane, low, middle, high) of.low = count++, of.middle = count++, of.high = count++;
    {
        gpu::View& of = view;
        PACKED_VIEW(FILL_FLOAT, FILL_UINT)
    }
    {
        gpu::LightGrid& of = grid;
        PACKED_GRID(FILL_FLOAT, FILL_SHORTS, FILL_BYTES)
    }
    const PackedView t = packedView(view, grid);
    std::size_t fields = 0;
    const auto same = [&](const char* field, auto unpacked, auto value) {
        EXPECT_EQ(unpacked, value) << field;
        ++fields;
    };
#define SAME_FLOAT(texel, lane, member) same(#member, std::bit_cast<float>(t[texel].lane), of.member);
#define SAME_UINT(texel, lane, member) same(#member, t[texel].lane, of.member);
#define SAME_SHORTS(texel, lane, low, high)      \
    same(#low, t[texel].lane & 0xffffu, of.low); \
    same(#high, t[texel].lane >> 16, of.high);
#define SAME_BYTES(texel, lane, low, middle, high)        \
    same(#low, t[texel].lane & 0xffu, of.low);            \
    same(#middle, t[texel].lane >> 8 & 0xffu, of.middle); \
    same(#high, t[texel].lane >> 16, of.high);
    {
        const gpu::View& of = view;
        PACKED_VIEW(SAME_FLOAT, SAME_UINT)
    }
    {
        const gpu::LightGrid& of = grid;
        PACKED_GRID(SAME_FLOAT, SAME_SHORTS, SAME_BYTES)
    }
    EXPECT_EQ(fields, 23u);
}

TEST(ShaderContract, ALaneThatIsFilledTwiceOrNotAtAllIsFound) {
    std::vector<unsigned> lanes;
    for (unsigned i = 0; i < 4 * gpu::PACKED_VIEW_TEXELS; ++i) lanes.push_back(i);
    EXPECT_TRUE(eachLaneOnce(lanes));
    lanes[7] = 8;
    EXPECT_FALSE(eachLaneOnce(lanes));
    lanes[7] = 20;
    EXPECT_FALSE(eachLaneOnce(lanes));
    lanes.erase(lanes.begin() + 7);
    EXPECT_FALSE(eachLaneOnce(lanes));
}

// Derivatives and mip levels use differences within a pixel quad, undefined if one invocation has ended.
// So alpha masks demote to helper invocations instead.
constexpr std::uint32_t opKill = 252, opTerminateInvocation = 4416, opDemote = 5380;
std::size_t ends(std::span<const std::uint32_t> words) {
    const SpirvModule module(words);
    return module.count(opKill) + module.count(opTerminateInvocation);
}

TEST(ShaderContract, NoInvocationEndsBeforeItsNeighbours) {
    std::size_t demoting = 0;
    for (const ShaderModule& module : shaderModules()) {
        EXPECT_EQ(ends(module.words), 0u) << module.name;
        demoting += SpirvModule(module.words).count(opDemote);
    }
    EXPECT_GT(demoting, 8u);
}

TEST(ShaderContract, AnInvocationThatEndsIsFound) {
    for (const std::uint32_t op : {opKill, opTerminateInvocation}) {
        const auto module = shaderModule(Shader::gbuffer_frag).words;
        std::vector<std::uint32_t> words(module.begin(), module.end());
        std::ranges::replace(words, std::uint32_t{1 << 16 | opDemote}, std::uint32_t{1 << 16 | op});
        EXPECT_EQ(ends(words), 1u);
    }
}

// CONTRACT_LANE, which accompanies each struct that shaders read as texels.
TEST(ShaderContract, AMemberThatMovesToAnotherLaneIsFound) {
    struct Swapped {
        float inverse_range_squared;
        gpu::vec3 position, intensity;
        float range;
    };
    EXPECT_TRUE(gpu::beginsAt(offsetof(gpu::Light, position), 0, 0));
    EXPECT_TRUE(gpu::beginsAt(offsetof(gpu::Light, range), 1, 3));
    EXPECT_FALSE(gpu::beginsAt(offsetof(Swapped, position), 0, 0));
    EXPECT_FALSE(gpu::beginsAt(offsetof(Swapped, inverse_range_squared), 0, 3));
    EXPECT_TRUE(gpu::beginsAt(offsetof(Swapped, range), 1, 3));
}

}  // namespace
}  // namespace diptych
