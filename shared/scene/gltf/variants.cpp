// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/variants.h"

#include "shared/scene/gltf/value.h"
#include "shared/text/fail.h"
#include "shared/text/indexed_names.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string_view>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;

constexpr const char* variantsExtension = "KHR_materials_variants";

const Json& arrayIn(const Json& object, const char* key, std::string_view who) {
    const Json* found = memberOf(object, key);
    if (!found || !found->is_array()) fail(fmt::format("{}: has no array {}", who, key));
    return *found;
}

// `root`: the document's extension; null if absent.
std::vector<std::string> variantNames(const Json& root, NoteList& notes) {
    std::vector<std::string> names;
    if (root.is_null()) return names;
    readOrNote(notes, [&] {
        for (const Json& variant : arrayIn(root, "variants", variantsExtension)) {
            const Json* name = memberOf(variant, "name");
            const bool named = name && name->is_string();
            if (!named)
                notes.add(fmt::format("{}: variant {}: has no name; only its index selects it",
                                      variantsExtension, names.size()));
            names.push_back(named ? oneLine(name->get_ref<const std::string&>()) : std::string());
        }
    });
    return names;
}

int chosenVariant(const std::vector<std::string>& names, const std::string& choice) {
    if (choice.empty()) return -1;
    const std::string name = oneLine(choice), who = fmt::format("--variant \"{}\"", name);
    if (names.empty()) fail(who, "the file has no material variants");
    const auto index = indexOfNamed(name, names, who);
    if (!index) fail(who, "the file's variants are " + indexedNames(names));
    return static_cast<int>(*index);
}

// Materials by variant, from a primitive's extension `use`. Each variant may occur once; the first counts.
// `variants`, `materials`: their numbers in the file.
std::map<int, int> mappingOf(const Json& use, std::size_t variants, std::size_t materials,
                             const std::string& who, NoteList& notes) {
    std::map<int, int> mapped;
    const auto add = [&](const Json& mapping, const std::string& where) {
        const Json* index = memberOf(mapping, "material");
        if (!index) fail(where, "has no material");
        const int material = indexBelow(*index, materials, where + ": material");
        const Json& list = arrayIn(mapping, "variants", where);
        for (std::size_t i = 0; i < list.size(); ++i)
            readOrNote(notes, [&] {
                const std::string entry = fmt::format("{}: variants[{}]", where, i);
                const int variant = indexBelow(list[i], variants, entry);
                if (!mapped.emplace(variant, material).second)
                    fail(entry, fmt::format("variant {} already has a material", variant));
            });
    };
    readOrNote(notes, [&] {
        const Json& mappings = arrayIn(use, "mappings", who);
        for (std::size_t i = 0; i < mappings.size(); ++i)
            readOrNote(notes, [&] { add(mappings[i], fmt::format("{}: mapping {}", who, i)); });
    });
    return mapped;
}

}  // namespace

Variants takeVariants(Json& document, const std::string& choice) {
    NoteList notes("material variants");
    Variants result;
    result.names = variantNames(takeExtension(document, variantsExtension), notes);
    result.chosen = chosenVariant(result.names, choice);
    const std::size_t meshes = arrayAt(document, "/meshes").size(),
                      materials = arrayAt(document, "/materials").size();
    for (std::size_t m = 0; m < meshes; ++m) {
        Json& mesh = document["meshes"][m];
        if (!memberOf(mesh, "primitives") || !mesh["primitives"].is_array()) continue;
        for (std::size_t p = 0; Json & primitive : mesh["primitives"]) {
            const std::string who = fmt::format("mesh {}, primitive {}: {}", m, p++, variantsExtension);
            const Json use = takeExtension(primitive, variantsExtension);
            if (use.is_null()) continue;
            const std::map<int, int> mapped = mappingOf(use, result.names.size(), materials, who, notes);
            if (const auto found = mapped.find(result.chosen); found != mapped.end())
                primitive["material"] = found->second;
        }
    }
    notes.moveTo(result.notes);
    return result;
}

}  // namespace diptych::gltf
