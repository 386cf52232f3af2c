// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/file.h"

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/properties.h"
#include "shared/scene/gltf/schema.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"
#include "shared/text/json.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

void addExtensions(std::span<const schema::Property> properties, std::set<std::string_view>& names) {
    for (const schema::Property& p : properties) {
        addExtensions(p.properties, names);
        if (p.kind == schema::Kind::extensions)
            for (const schema::Property& extension : p.properties) names.insert(extension.key);
    }
}

// Whether the schema has the extension or it is read before; only the presence of image formats is read.
bool isBuilt(std::string_view extension) {
    static const std::set<std::string_view> built = [] {
        std::set<std::string_view> names{"EXT_lights_image_based", "KHR_materials_variants",
                                         "KHR_mesh_quantization"};
        addExtensions(schema::document, names);
        for (const char* format : {"EXT_texture_avif", "KHR_texture_basisu"}) names.erase(format);
        return names;
    }();
    return built.contains(extension);
}

// ---- container ---------------------------------------------------------------------------------------

// Byte ranges of the JSON and binary chunks.
struct Container {
    struct Range {
        std::size_t offset = 0, size = 0;
    };
    Range json;
    std::optional<Range> binary;
    std::vector<std::string> notes = {};
};

std::uint32_t word(const Bytes& bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

// glTF 2.0, 4.4: a header of three words, then chunks of length, type and data.
Container readContainer(const Bytes& bytes) {
    constexpr std::uint32_t json = 0x4e4f534a, binary = 0x004e4942;  // "JSON", "BIN\0"
    if (bytes.size() < 4 || std::memcmp(bytes.data(), "glTF", 4) != 0) return {{0, bytes.size()}, {}, {}};
    if (bytes.size() < 12) fail(fmt::format("is cut short: {} of 12 header bytes", bytes.size()));
    const std::size_t length = word(bytes, 8);
    if (word(bytes, 4) != 2) fail(fmt::format("binary glTF version {}, not 2", word(bytes, 4)));
    if (length > bytes.size())
        fail(fmt::format("is cut short: {} of the {} bytes in its header", bytes.size(), length));
    Container container;
    if (length < bytes.size())
        container.notes.push_back(fmt::format("{} after the {} in its header: ignored",
                                              counted(bytes.size() - length, "byte"), length));
    std::size_t binaries = 0;
    for (std::size_t at = 12, chunk = 0; at < length; ++chunk) {
        if (length - at < 8) fail(fmt::format("chunk {}: its header ends past the file", chunk));
        const std::size_t size = word(bytes, at);
        const std::uint32_t type = word(bytes, at + 4);
        if (size > length - at - 8)
            fail(fmt::format("chunk {}: {} bytes end at {}, past the file's {}", chunk, size, at + 8 + size,
                             length));
        if (chunk == 0) {
            if (type != json) fail("chunk 0: is not JSON");
            container.json = {at + 8, size};
        } else if (type == binary && binaries++ == 0) {
            container.binary = {at + 8, size};
        }
        at += 8 + size;
    }
    if (container.json.size == 0) fail("holds no JSON chunk");
    if (binaries > 1)
        container.notes.push_back(fmt::format("{} binary chunks: only the first is read", binaries));
    return container;
}

// ---- document ----------------------------------------------------------------------------------------

// Whether a version is malformed or newer than 2.0.
bool isBeyond(const std::string& version) {
    int major = 0, minor = 0;
    char end = 0;
    const int found = std::sscanf(version.c_str(), "%4d.%4d%c", &major, &minor, &end);
    return found != 2 || major > 2 || (major == 2 && minor > 0);
}

void checkVersion(const Json& document) {
    const auto asset = document.find("asset");
    const auto text = [&](const char* key) {
        const Json value = asset != document.end() && asset->is_object() ? asset->value(key, Json()) : Json();
        if (!value.is_null() && !value.is_string())
            fail(fmt::format("asset: {} is {}, not a string; write \"2.0\"", key, oneLine(value.dump())));
        return value.is_string() ? value.get<std::string>() : std::string();
    };
    const std::string version = text("version"), min = text("minVersion");
    if (version.empty()) fail("asset: has no version");
    if (!version.starts_with("2.")) fail(fmt::format("asset: version {}, not 2.0", oneLine(version)));
    if (!min.empty() && isBeyond(min))
        fail(fmt::format("asset: minVersion {} is not supported; 2.0 is", oneLine(min)));
}

void checkRequired(const Json& document) {
    const auto required = document.find("extensionsRequired");
    if (required == document.end() || required->is_null()) return;
    if (!required->is_array()) fail("extensionsRequired: is not an array");
    std::string missing;
    for (const Json& name : *required) {
        if (!name.is_string()) fail("extensionsRequired: contains a value that is not a name");
        if (!isBuilt(name.get<std::string>()))
            missing += (missing.empty() ? "" : ", ") + name.get<std::string>();
    }
    if (!missing.empty())
        fail(fmt::format("extensionsRequired: {} is not supported; export the scene without it",
                         oneLine(missing)));
}

// ---- buffers and images ------------------------------------------------------------------------------

// A fallback buffer for readers without EXT_meshopt_compression may be empty.
bool mayBeEmpty(const Json& buffer) {
    return extension(buffer, "EXT_meshopt_compression");
}

Bytes bytesOf(const Json& json, bool isFirst, Bytes& file, const std::optional<Container::Range>& binary,
              const Resources& resources, std::vector<std::string>& notes) {
    const auto length = json["byteLength"].get<std::uint64_t>();
    Bytes data;
    if (const auto uri = json.find("uri"); uri != json.end()) {
        data = resources.read(uri->get_ref<const std::string&>(), length, notes);
    } else if (isFirst && binary) {
        file.resize(binary->offset + binary->size);
        file.erase(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(binary->offset));
        data = std::move(file);
    } else if (mayBeEmpty(json)) {
        fail("has no data: it is a fallback for readers without EXT_meshopt_compression");
    } else {
        fail("has no uri, and the file has no binary chunk for it");
    }
    data.resize(std::min<std::uint64_t>(data.size(), length));
    return data;
}

// If the first buffer of a .glb has no uri, it is the binary chunk, and `bytes` is moved into it. A
// missing buffer is an error only if it is read.
void loadBuffers(const Json& buffers, Bytes& bytes, const std::optional<Container::Range>& binary,
                 Document& out) {
    std::uint64_t total = 0;
    NoteList notes("buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const Json& json = buffers[i];
        const std::string who = fmt::format("buffer {}", i);
        const auto length = json["byteLength"].get<std::uint64_t>();
        total += length;
        if (length > MAX_BUFFER_BYTES || total > MAX_BUFFER_BYTES)
            fail(fmt::format("{}: the buffers together exceed the limit of {} bytes", who, MAX_BUFFER_BYTES));
        tinygltf::Buffer& buffer = out.model.buffers.emplace_back();
        buffer.name = json.value("name", std::string());
        try {
            std::vector<std::string> found;
            buffer.data = bytesOf(json, i == 0, bytes, binary, out.resources, found);
            for (const std::string& note : found) notes.add(fmt::format("{}: {}", who, note));
            if (buffer.data.size() < length) {
                setMissing(buffer, fmt::format("{}: has {} of the {} bytes in its byteLength", who,
                                               buffer.data.size(), length));
                notes.add(missing(buffer) + ": the scene does not use the rest");
            }
        } catch (const std::runtime_error& e) {
            setMissing(buffer, fmt::format("{}: {}", who, e.what()));
            if (!mayBeEmpty(json) || json.contains("uri"))
                notes.add(missing(buffer) + ": the scene does not use it");
        }
    }
    notes.moveTo(out.notes);
}

// Notes bufferViews that end past a complete buffer.
void noteCutViews(Document& out) {
    NoteList notes("bufferViews");
    for (std::size_t i = 0; i < out.model.bufferViews.size(); ++i) {
        // An omitted bufferView refers to buffer 0, which may not exist.
        const auto buffer = static_cast<std::size_t>(out.model.bufferViews[i].buffer);
        if (buffer >= out.model.buffers.size() || !missing(out.model.buffers[buffer]).empty()) continue;
        if (const std::string cut = cutOf(out.model, static_cast<int>(i)); !cut.empty())
            notes.add(cut + ": the scene does not use the rest");
    }
    notes.moveTo(out.notes);
}

// Lists names and locations of the images; decodes nothing.
void listImages(const Json& images, Model& model) {
    for (std::size_t i = 0; i < images.size(); ++i) {
        tinygltf::Image& image = model.images.emplace_back();
        image.name = images[i].value("name", std::string());
        image.uri = images[i].value("uri", std::string());
        image.bufferView = images[i].value("bufferView", -1);
        image.as_is = true;
    }
}

// Moves all extensions and our extras out of `value`. Returns them in a value of the same shape that has
// nothing else; null if there are none.
Json takeAdditions(Json& value) {
    Json taken;
    if (value.is_array()) {
        for (std::size_t i = 0; i < value.size() && value[i].is_structured(); ++i)
            if (Json of = takeAdditions(value[i]); !of.is_null()) taken[i] = std::move(of);
    } else {
        for (auto at = value.begin(); at != value.end();) {
            if (at->is_object() && (at.key() == "extensions" || at.key() == "extras")) {
                taken[at.key()] = std::move(at.value());
                at = value.erase(at);
                continue;
            }
            if (at->is_structured())
                if (Json of = takeAdditions(*at); !of.is_null()) taken[at.key()] = std::move(of);
            ++at;
        }
    }
    return taken;
}

// Splits the checked document: returns the part that tinygltf loads and leaves the rest.
Json takeTinygltfPart(Json& document) {
    Json part{{"asset", {{"version", "2.0"}}}};
    for (const char* key :
         {"accessors", "animations", "bufferViews", "cameras", "meshes", "nodes", "scene", "scenes", "skins"})
        if (const auto at = document.find(key); at != document.end()) part[key] = std::move(*at);
    // tinygltf omits channels without a node. One whose target is a pointer gets node 0,
    // which is ignored; the others move nothing.
    for (Json& animation : part["animations"])
        std::erase_if(animation["channels"].get_ref<Json::array_t&>(), [](Json& channel) {
            Json& target = channel["target"];
            if (!target.contains("node") && target["path"] == "pointer" &&
                extension(target, "KHR_animation_pointer"))
                target["node"] = 0;
            return !target.contains("node");
        });
    if (Json taken = takeAdditions(part); !taken.is_null()) document.update(taken);
    return part;
}

// `part`: from takeTinygltfPart(). It refers to no files.
void parseModel(Json part, Model& model) {
    // tinygltf refuses indices whose accessor has no bufferView, which glTF 2.0 (3.6.2.3) allows.
    std::vector<int> indices;
    for (Json& mesh : part["meshes"])
        for (Json& primitive : mesh["primitives"]) {
            indices.push_back(primitive.value("indices", -1));
            primitive.erase("indices");
        }
    const std::string text = part.dump();
    part = nullptr;  // free it, because tinygltf builds the same tree again
    tinygltf::TinyGLTF parser;
    std::string error, warning;
    bool parsed = false;
    try {
        parsed = parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                            static_cast<unsigned int>(text.size()), "");
    } catch (const std::exception& e) {
        fail(firstLine(e.what()));
    }
    if (!parsed) fail(error.empty() ? "is not glTF" : firstLine(error));
    for (std::size_t i = 0; tinygltf::Mesh & mesh : model.meshes)
        for (tinygltf::Primitive& primitive : mesh.primitives) primitive.indices = indices.at(i++);
}

// Readers may ignore an extension that extensionsUsed does not list (glTF 2.0, 3.12).
void noteUndeclared(const Schema& found, std::vector<std::string>& notes) {
    NoteList list("extensions");
    for (const std::string& name : found.extensions)
        if (!found.declared.contains(name)) list.add(name + ": is used but missing from extensionsUsed");
    list.moveTo(notes);
}

// Parses the document and checks its version and required extensions.
Json documentOf(const Bytes& bytes, const Container& container) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()) + container.json.offset,
                                container.json.size);
    if (text.empty()) fail("is empty");
    if (text.size() > MAX_JSON_BYTES)
        fail(fmt::format("its JSON has {} bytes; the limit is {}", text.size(), MAX_JSON_BYTES));
    Json document = parseJson(text, {.values = MAX_JSON_VALUES, .objects = MAX_JSON_OBJECTS});
    if (!document.is_object()) fail("its JSON is not an object");
    checkVersion(document);
    checkRequired(document);
    return document;
}

}  // namespace

void checkHeader(const Bytes& bytes, const std::string& variant) {
    Json document = documentOf(bytes, readContainer(bytes));
    takeVariants(document, variant);
}

Document open(Bytes bytes, const std::filesystem::path& folder, const std::string& variant) {
    const Container container = readContainer(bytes);
    Document result{{}, Resources(folder), {}, {}, {}, {}, {}};
    Json document = documentOf(bytes, container);
    result.image_lights = takeImageLights(document);
    result.variants = takeVariants(document, variant);
    Schema found = applySchema(document);
    result.notes = container.notes;
    for (const auto* notes : {&result.image_lights.notes, &result.variants.notes, &found.notes})
        result.notes.insert(result.notes.end(), notes->begin(), notes->end());
    for (const auto& [name, where] : found.misplaced)
        if (isBuilt(name))
            result.notes.push_back(fmt::format("{}: {} is not supported there: left out",
                                               where.empty() ? "the document" : where, name));
    result.broken_meshes = std::move(found.broken_meshes);
    if (!result.variants.names.empty()) found.extensions.insert("KHR_materials_variants");
    if (!result.image_lights.scenes.empty()) found.extensions.insert("EXT_lights_image_based");
    noteUndeclared(found, result.notes);
    result.ignored_extensions = std::move(found.extensions);
    result.ignored_extensions.merge(found.declared);
    std::erase_if(result.ignored_extensions, [](const std::string& name) { return isBuilt(name); });
    const Json buffers = std::move(document["buffers"]), images = std::move(document["images"]);
    parseModel(takeTinygltfPart(document), result.model);
    result.model.rest = std::move(document);
    loadBuffers(buffers, bytes, container.binary, result);
    noteCutViews(result);
    listImages(images, result.model);
    return result;
}

}  // namespace diptych::gltf
