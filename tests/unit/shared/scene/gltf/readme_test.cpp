// SPDX-License-Identifier: MIT
// The glTF README names every extension of the schema.
#include "shared/scene/gltf/properties.h"
#include "tests/support/sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>

namespace diptych::gltf {
namespace {

void addExtensions(std::span<const schema::Property> properties, std::set<std::string>& names) {
    for (const schema::Property& p : properties) {
        if (p.kind == schema::Kind::extensions)
            for (const schema::Property& extension : p.properties) names.emplace(extension.key);
        addExtensions(p.properties, names);
    }
}

// Extensions that the page does not name; it leaves out a prefix that repeats.
Faults unnamed(const std::string& page) {
    const std::string prefix = "KHR_materials";
    const auto says = [&](const std::string& name) { return page.find("`" + name + "`") != page.npos; };
    std::set<std::string> names;
    addExtensions(schema::document, names);
    Faults faults;
    for (const std::string& name : names)
        if (!says(name) && !(name.starts_with(prefix) && says(name.substr(prefix.size()))))
            faults.push_back(name);
    return faults;
}

TEST(GltfReadme, NamesEveryExtensionThatIsRead) {
    EXPECT_EQ(joined(unnamed(sources().at("shared/scene/gltf/README.md"))), "");
}

TEST(GltfReadme, AMissingNameIsFound) {
    EXPECT_GT(unnamed("`_sheen`").size(), 20u);
    EXPECT_EQ(std::ranges::count(unnamed("`_sheen`"), "KHR_materials_sheen"), 0);
    EXPECT_EQ(std::ranges::count(unnamed("`_sheens`"), "KHR_materials_sheen"), 1);
}

}  // namespace
}  // namespace diptych::gltf
