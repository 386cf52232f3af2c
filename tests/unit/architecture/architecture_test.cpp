// SPDX-License-Identifier: MIT
// Checks the architecture's rules on the project's own files. Each check has a negative control with an
// injected fault.
#include "tests/support/sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace diptych {
namespace {

// A module may include itself and modules of lower layers. If `only` is not empty, only those modules.
struct Module {
    std::string path;
    int floor;
    std::vector<std::string> only{};
};
// The scene library does not depend on Vulkan or Settings.
const std::vector<std::string> belowScene{
    "shared/contract",     "shared/text",        "shared/image",
    "shared/scene/model",  "shared/scene/image", "shared/scene/motion",
    "shared/scene/lights", "shared/scene/gltf",  "shared/scene/builtin"};
const std::vector<Module> modules = {
    {"shared/contract", 0},
    {"shaders/lib", 1, {"shared/contract"}},
    {"shaders/pass", 2, {"shared/contract", "shaders/lib"}},
    {"shared/text", 5},
    {"shared/image", 10},
    {"shared/frame", 20},
    {"shared/vulkan", 20, {"shared/contract", "shared/text"}},
    {"shared/scene/model", 20, belowScene},
    {"shared/scene/image", 21, belowScene},
    {"shared/scene/motion", 21, belowScene},
    {"shared/scene/lights", 22, belowScene},
    {"shared/scene/gltf", 23, belowScene},
    {"shared/scene/builtin", 23, belowScene},
    {"shared/scene", 24, belowScene},
    {"shared/material", 30},
    {"shared/light", 30},
    {"shared/environment", 30},
    {"shared/draw", 31},
    {"shared/shadow", 32},
    {"shared/transparent", 33},
    {"forward_plus", 40},
    {"deferred", 40},
    {"compare/run", 40, {"shared/text", "shared/image", "shared/frame"}},
    {"compare/metrics", 40, {"shared/contract", "shared/image", "shared/frame"}},
    {"compare/reference",
     40,
     {"shared/contract", "shared/image", "shared/frame", "shared/scene", "shared/scene/model",
      "shared/scene/motion"}},
    {"compare/files", 41},
    {"compare/image", 41},
    {"compare/page", 41},
    {"compare/plot", 42},
    {"compare/output", 43},
    {"compare/frames", 45},
    {"compare/checks", 46},
    {"compare/render", 50},
    {"compare/external", 51},
    {"compare/verdict", 50},
    {"compare/experiment", 65},
    {"compare/report", 70},
    {"compare/explain", 70},
    {"compare/tradeoff", 70},
    {"compare/choose", 70},
    {"compare/audit", 70},
    {"compare/bench", 70},
    {"compare/probe", 70},
    {"compare/shards", 72},
    {"compare/viewer", 75},
    {"compare/library", 75},
    {"compare/cli", 80},
    {"tests", 90},
};

// Innermost module that contains the file; nullptr if there is none.
const Module* moduleOf(const std::string& path) {
    const Module* best = nullptr;
    for (const Module& module : modules)
        if (path.starts_with(module.path + "/") && (!best || module.path.size() > best->path.size()))
            best = &module;
    return best;
}

// Quoted includes of a higher layer or of another module of the same layer; for the contract, of any other
// module.
Faults climbingIncludes(const Files& files, const std::string& path) {
    Faults faults;
    const Module* from = isCode(path) ? moduleOf(path) : nullptr;
    if (!from) return faults;
    for (const std::string& target : quotedIncludes(files, path)) {
        const Module* to = moduleOf(target);
        if (from->floor == 0 && to != from) {
            faults.push_back(path + " includes " + target + ", outside the contract");
        } else if (to && to != from) {
            const bool listed = from->only.empty() || std::ranges::count(from->only, to->path) > 0;
            if (to->floor >= from->floor || !listed) faults.push_back(path + " includes " + target);
        }
    }
    return faults;
}

TEST(Architecture, IncludesOnlyGoDown) {
    Faults faults;
    for (const auto& [path, text] : sources())
        std::ranges::move(climbingIncludes(sources(), path), std::back_inserter(faults));
    EXPECT_EQ(joined(faults), "");
}

TEST(Architecture, APlantedClimbIsFound) {
    auto plant = [files = sources()](const std::string& path, const std::string& include) mutable {
        files[path] = "// SPDX-License-Identifier: MIT\n#include \"" + include + "\"\n";
        return climbingIncludes(files, path).size();
    };
    EXPECT_EQ(plant("shared/image/planted.h", "shared/scene/model/scene.h"), 1u);
    EXPECT_EQ(plant("shared/scene/model/planted.h", "shared/frame/frame.h"), 1u);
    EXPECT_EQ(plant("shared/scene/builtin/planted.h", "../../vulkan/device/device.h"), 1u);
    EXPECT_EQ(plant("shared/vulkan/planted.cpp", "shared/scene/model/scene.h"), 1u);
    EXPECT_EQ(plant("shared/light/planted.h", "shared/material/materials.h"), 1u);
    EXPECT_EQ(plant("shared/light/planted.h", "shared/draw/draws.h"), 1u);
    EXPECT_EQ(plant("shared/contract/planted.h", "shared/image/image.h"), 1u);
    EXPECT_EQ(plant("shared/contract/planted.h", "elsewhere.h"), 1u);
    EXPECT_EQ(plant("deferred/planted.cpp", "forward_plus/forward_plus.h"), 1u);
    EXPECT_EQ(plant("compare/reference/planted.cpp", "shared/vulkan/device/device.h"), 1u);
    EXPECT_EQ(plant("shaders/lib/planted.glsl", "shaders/pass/surface.vert"), 1u);
    EXPECT_EQ(plant("shared/draw/planted.h", "compare/render/renderer.h"), 1u);
    // includes that lead downwards are allowed
    EXPECT_EQ(plant("shared/contract/planted.h", "types.h"), 0u);
    EXPECT_EQ(plant("compare/render/planted.cpp", "deferred/deferred.h"), 0u);
    EXPECT_EQ(plant("shared/draw/planted.h", "shared/light/lights.h"), 0u);
}

// Code outside every module would have no layer and no README.
Faults withoutModule(const Files& files) {
    Faults faults;
    for (const auto& [path, text] : files)
        if (isCode(path) && !path.starts_with("shaders/tool/") && !moduleOf(path)) faults.push_back(path);
    return faults;
}

TEST(Architecture, EveryFileOfCodeIsInAModule) {
    EXPECT_EQ(joined(withoutModule(sources())), "");
    EXPECT_EQ(withoutModule({{"compare/planted/a.cpp", ""}, {"compare/run/a.cpp", ""}}),
              Faults{"compare/planted/a.cpp"});
}

// Circular includes between units; a unit is a header and its source. Each cycle is one line that names
// one of its units.
Faults circularIncludes(const Files& files) {
    const auto unitOf = [](const std::string& path) {
        return endsIn(path, {".cpp", ".h"}) ? path.substr(0, path.rfind('.')) : path;
    };
    std::map<std::string, std::set<std::string>> uses;
    for (const auto& [path, text] : files) {
        if (!isCode(path)) continue;
        for (const std::string& target : quotedIncludes(files, path)) {
            if (files.contains(target) && unitOf(target) != unitOf(path))
                uses[unitOf(path)].insert(unitOf(target));
        }
    }
    Faults faults;
    std::map<std::string, int> state;  // 1: on the current walk, 2: done
    const std::function<void(const std::string&)> visit = [&](const std::string& unit) {
        state[unit] = 1;
        for (const std::string& next : uses[unit])
            if (state[next] == 1)
                faults.push_back(unit + " and " + next + " include each other, directly or through others");
            else if (state[next] == 0)
                visit(next);
        state[unit] = 2;
    };
    for (const auto& [path, text] : files)
        if (isCode(path) && state[unitOf(path)] == 0) visit(unitOf(path));
    return faults;
}

TEST(Architecture, NoUnitsIncludeEachOther) {
    EXPECT_EQ(joined(circularIncludes(sources())), "");
}

TEST(Architecture, APlantedCircleIsFound) {
    const Files chain{{"compare/a.h", "#include \"compare/b.h\"\n"},
                      {"compare/b.cpp", "#include \"compare/c.h\"\n"},
                      {"compare/b.h", ""},
                      {"compare/c.h", ""}};
    EXPECT_EQ(joined(circularIncludes(chain)), "");
    Files circle = chain;
    circle["compare/c.cpp"] = "#include \"compare/a.h\"\n";
    EXPECT_EQ(circularIncludes(circle).size(), 1u);
    Files direct = chain;
    direct["compare/b.h"] = "#include \"a.h\"\n";
    EXPECT_EQ(circularIncludes(direct).size(), 1u);
}

// The reference must be independent of the paths. From the contract it may use only the channels; from
// other modules only the scene's description.
Faults borrowedByTheReference(const Files& files) {
    static const std::regex contract("gpu::(?!DEBUG_|uint\\b)\\w+");
    static const std::vector<std::string> open{"compare/reference/", "shared/image/", "shared/frame/",
                                               "shared/scene/"};
    Faults faults;
    for (const auto& [path, text] : files) {
        if (!path.starts_with("compare/reference/") || !isCode(path)) continue;
        for (const std::string& target : quotedIncludes(files, path)) {
            const bool fine =
                target == "shared/contract/debug_mode.h" ||
                std::ranges::any_of(open, [&](const std::string& r) { return target.starts_with(r); });
            if (!fine) faults.push_back(path + " includes " + target);
        }
        for (std::sregex_iterator it(text.begin(), text.end(), contract), end; it != end; ++it)
            faults.push_back(path + " uses " + it->str());
    }
    return faults;
}

TEST(Architecture, TheReferenceBorrowsNothing) {
    EXPECT_EQ(joined(borrowedByTheReference(sources())), "");
}

TEST(Architecture, APlantedLoanOfTheReferenceIsFound) {
    const auto plant = [](const std::string& line) {
        return borrowedByTheReference({{"compare/reference/planted.cpp", line + "\n"}}).size();
    };
    for (const char* header :
         {"shared/contract/material.h", "shared/contract/light.h", "shared/contract/constants.h",
          "shared/light/lights.h", "shared/material/materials.h", "shared/draw/draws.h",
          "shared/vulkan/device/device.h", "shaders/lib/shading/brdf.glsl", "compare/render/renderer.h",
          "../metrics/channel.h", "../../shared/contract/view.h"})
        EXPECT_EQ(plant(std::string("#include \"") + header + "\""), 1u) << header;
    EXPECT_EQ(plant("const double a = gpu::MIN_ROUGHNESS;"), 1u);
    EXPECT_EQ(plant("const float a = gpu::PI;"), 1u);
    EXPECT_EQ(plant("#include \"shared/contract/debug_mode.h\""), 0u);
    EXPECT_EQ(plant("case Channel::lit: return static_cast<gpu::uint>(0);"), 0u);
    EXPECT_EQ(plant("#include \"shared/scene/model/scene.h\""), 0u);
}

// Documentation: the top README fits one page, each module has a README, and every link between them
// resolves.
Faults documentationFaults(const Files& files) {
    constexpr long max_lines = 150;
    static const std::regex relative_link("\\]\\(([^)#]+)(#[^)]*)?\\)");  // [words](file#heading)
    Faults faults;
    const auto isThere = [&](const std::string& path) {
        const auto first = files.lower_bound(path + "/");  // of a folder
        return files.contains(path) || (first != files.end() && first->first.starts_with(path + "/"));
    };
    for (const Module& module : modules) {
        // Both shader folders share one README.
        const std::string folder = module.path.starts_with("shaders/") ? "shaders" : module.path;
        const auto first = files.lower_bound(module.path + "/");
        const bool exists = first != files.end() && first->first.starts_with(module.path + "/");
        if (exists && !isThere(folder + "/README.md")) faults.push_back(module.path + " has no README.md");
    }
    for (const auto& [path, text] : files) {
        if (fs::path(path).filename() != "README.md" && path != "SECURITY.md") continue;
        const long lines = std::ranges::count(text, '\n');
        if (path == "README.md" && lines > max_lines)
            faults.push_back(path + " has " + std::to_string(lines) + " lines");
        for (std::sregex_iterator it(text.begin(), text.end(), relative_link), end; it != end; ++it) {
            const std::string target = (*it)[1].str();
            if (target.find("://") != std::string::npos) continue;
            if (!isThere((fs::path(path).parent_path() / target).lexically_normal().generic_string()))
                faults.push_back(path + " links to " + target + ", which is not there");
        }
    }
    return faults;
}

TEST(Architecture, EveryModuleIsDocumentedAndNoLinkIsDead) {
    EXPECT_EQ(joined(documentationFaults(sources())), "");
}

TEST(Architecture, APlantedFaultOfTheDocumentationIsFound) {
    const Files sound{
        {"README.md", "[the page](shared/text/README.md#words), [a site](https://example.org/a)\n"},
        {"shared/text/README.md",
         "[the code](json.h), [its folder](../text) and [the top](../../README.md)\n"},
        {"shared/text/json.h", ""},
        {"shaders/README.md", ""},
        {"shaders/lib/shading/brdf.glsl", ""}};
    EXPECT_EQ(joined(documentationFaults(sound)), "");
    Files files = sound;
    files["README.md"] = std::string(151, '\n');
    EXPECT_EQ(documentationFaults(files), Faults{"README.md has 151 lines"});
    files["README.md"] = std::string(150, '\n');
    EXPECT_EQ(joined(documentationFaults(files)), "");
    files = sound;
    files.erase("shared/text/json.h");
    EXPECT_EQ(documentationFaults(files),
              Faults{"shared/text/README.md links to json.h, which is not there"});
    files = sound;
    files["shared/image/image.h"] = "";
    EXPECT_EQ(documentationFaults(files), Faults{"shared/image has no README.md"});
    files = sound;
    files.erase("shaders/README.md");
    EXPECT_EQ(documentationFaults(files), Faults{"shaders/lib has no README.md"});
}

}  // namespace
}  // namespace diptych
