// SPDX-License-Identifier: MIT
#include "shared/scene/gltf_file.h"

#include "shared/scene/gltf_value.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error(what);
}

Bytes readFile(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) fail("is a folder");
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream) fail(std::filesystem::exists(file, error) ? "cannot be read" : "no such file");
    Bytes bytes(static_cast<std::size_t>(std::max<std::streamoff>(stream.tellg(), 0)));
    stream.seekg(0);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream) fail("cannot be read");
    return bytes;
}

// ---- container ---------------------------------------------------------------------------------------

std::uint32_t word(const Bytes& bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16 | static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

// The JSON of a .glb, with every chunk inside the file.
std::string_view jsonOfBinary(const Bytes& bytes) {
    constexpr std::uint32_t json = 0x4e4f534a;  // "JSON"
    const std::size_t length = word(bytes, 8);
    if (word(bytes, 4) != 2) fail(fmt::format("binary glTF version {}, not 2", word(bytes, 4)));
    if (length > bytes.size())
        fail(fmt::format("is cut short: {} bytes of the {} that its header names", bytes.size(), length));
    std::string_view text;
    for (std::size_t at = 12, chunk = 0; at < length; ++chunk) {
        if (length - at < 8) fail(fmt::format("chunk {}: its header ends past the file", chunk));
        const std::size_t size = word(bytes, at);
        if (size > length - at - 8)
            fail(fmt::format("chunk {}: {} bytes end at {}, past the file's {}", chunk, size, at + 8 + size,
                             length));
        if (chunk == 0) {
            if (word(bytes, at + 4) != json) fail("chunk 0: is not JSON");
            text = {reinterpret_cast<const char*>(bytes.data()) + at + 8, size};
        }
        at += 8 + size;
    }
    if (text.empty()) fail("holds no JSON chunk");
    return text;
}

bool isBinary(const Bytes& bytes) {
    return bytes.size() >= 12 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

// ---- document ----------------------------------------------------------------------------------------

// tinygltf walks extras and extensions recursively; this bounds its stack. Files nest some ten deep.
constexpr int maxNesting = 128;

Json parse(std::string_view text) {
    const auto depth = [](int level, Json::parse_event_t, Json&) {
        if (level > maxNesting) fail(fmt::format("its JSON nests deeper than {}", maxNesting));
        return true;
    };
    try {
        Json document = Json::parse(text, depth);
        if (!document.is_object()) fail("its JSON is not an object");
        return document;
    } catch (const Json::exception& e) {
        fail(fmt::format("is not JSON: {}", firstLine(e.what())));
    }
}

constexpr std::array builtExtensions{"KHR_lights_punctual",  "KHR_materials_emissive_strength",
                                     "KHR_materials_ior",    "KHR_materials_specular",
                                     "KHR_materials_unlit",  "KHR_mesh_quantization",
                                     "KHR_texture_transform"};

void checkVersion(const Json& document) {
    const auto asset = document.find("asset");
    const Json version =
        asset != document.end() && asset->is_object() ? asset->value("version", Json()) : Json();
    if (!version.is_string()) fail("asset: names no version");
    if (!version.get<std::string>().starts_with("2."))
        fail(fmt::format("asset: version {}, not 2.0", version.get<std::string>()));
}

void checkRequired(const Json& document) {
    const auto required = document.find("extensionsRequired");
    if (required == document.end()) return;
    if (!required->is_array()) fail("extensionsRequired: is not an array");
    std::string missing;
    for (const Json& name : *required) {
        if (!name.is_string()) fail("extensionsRequired: holds something other than names");
        if (!isBuilt(name.get<std::string>()))
            missing += (missing.empty() ? "" : ", ") + name.get<std::string>();
    }
    if (!missing.empty()) fail(fmt::format("extensionsRequired: {} is not built", missing));
}

std::string percentDecoded(std::string_view uri) {
    const auto digit = [](char c) {
        return std::isdigit(static_cast<unsigned char>(c))
                   ? c - '0'
                   : std::tolower(static_cast<unsigned char>(c)) - 'a' + 10;
    };
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
            std::isxdigit(static_cast<unsigned char>(uri[i + 2]))) {
            result += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
            i += 2;
        } else {
            result += uri[i];
        }
    }
    return result;
}

// A relative path without a scheme, that never climbs above where it starts.
void checkUri(const std::string& who, const Json& uri) {
    if (!uri.is_string()) fail(who + ": its uri is not a string");
    const std::string& text = uri.get_ref<const std::string&>();
    if (text.starts_with("data:")) return;
    const std::string name = percentDecoded(text);
    if (name.empty()) fail(who + ": its uri is empty");
    if (name.find('\0') != name.npos) fail(who + ": its uri holds a null character");
    if (name.find("://") != name.npos || name.starts_with("file:"))
        fail(fmt::format("{}: {}: only files beside the scene are read", who, name));
    if (name[0] == '/' || name[0] == '\\' || (name.size() > 1 && name[1] == ':'))
        fail(fmt::format("{}: {}: an absolute path leaves the scene's folder", who, name));
    int depth = 0;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find_first_of("/\\", begin), name.size());
        const std::string_view part = std::string_view(name).substr(begin, end - begin);
        depth += part == ".." ? -1 : (part.empty() || part == "." ? 0 : 1);
        if (depth < 0) fail(fmt::format("{}: {} leaves the scene's folder", who, name));
        begin = end + 1;
    }
}

// Buffers must be there; an image is missed only where a material reads it.
void checkUris(const Json& document, const std::filesystem::path& folder) {
    for (const auto& [kind, singular] : {std::pair{"buffers", "buffer"}, {"images", "image"}}) {
        const auto objects = document.find(kind);
        if (objects == document.end()) continue;
        if (!objects->is_array()) fail(fmt::format("{}: is not an array", kind));
        for (std::size_t i = 0; i < objects->size(); ++i) {
            const Json& object = (*objects)[i];
            const std::string who = fmt::format("{} {}", singular, i);
            if (!object.is_object()) fail(who + ": is not an object");
            if (!object.contains("uri")) continue;
            checkUri(who, object["uri"]);
            const std::string& uri = object["uri"].get_ref<const std::string&>();
            std::error_code error;
            if (*singular == 'b' && !uri.starts_with("data:") &&
                !std::filesystem::is_regular_file(folder / percentDecoded(uri), error))
                fail(fmt::format("{}: {}: no such file", who, percentDecoded(uri)));
        }
    }
}

// ---- tinygltf ----------------------------------------------------------------------------------------

// Keeps the encoded bytes of an image that came with its own; one in a bufferView is found there later,
// when that bufferView has been checked.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
    if (image->bufferView < 0 && size > 0) image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

// tinygltf also looks in the working directory, and would expand ~ and $ in names: neither here. The user
// data is the scene's folder.
bool exists(const std::string& file, void* folder) {
    std::error_code error;
    return file.starts_with(*static_cast<const std::string*>(folder)) &&
           std::filesystem::is_regular_file(file, error);
}
std::string asItIs(const std::string& file, void*) {
    return file;
}
bool readWhole(Bytes* out, std::string* error, const std::string& file, void*) {
    try {
        *out = readFile(file);
        return true;
    } catch (const std::exception& e) {
        *error = e.what();
        return false;
    }
}
bool refuseWrite(std::string*, const std::string&, const Bytes&, void*) {
    return false;
}

}  // namespace

bool isBuilt(std::string_view extension) {
    return std::find(builtExtensions.begin(), builtExtensions.end(), extension) != builtExtensions.end();
}

tinygltf::Model openFile(const std::filesystem::path& file) {
    const Bytes bytes = readFile(file);
    if (bytes.size() > std::numeric_limits<std::uint32_t>::max()) fail("is larger than 4 GiB");
    const bool binary = isBinary(bytes);
    const std::string_view text =
        binary ? jsonOfBinary(bytes)
               : std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const Json document = parse(text);
    checkVersion(document);
    checkRequired(document);
    checkUris(document, file.parent_path());

    // A slash at its end: no sibling folder's name can begin like this one's.
    std::string folder = file.parent_path().empty() ? "./" : file.parent_path().string() + "/";
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keepEncoded, nullptr);
    parser.SetFsCallbacks({exists, asItIs, readWhole, refuseWrite, &folder});
    tinygltf::Model model;
    std::string error, warning;
    bool parsed = false;
    try {
        const auto size = static_cast<unsigned int>(bytes.size());
        parsed = binary ? parser.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, folder)
                        : parser.LoadASCIIFromString(&model, &error, &warning, text.data(), size, folder);
    } catch (const std::exception& e) {
        fail(firstLine(e.what()));
    }
    if (!parsed) fail(error.empty() ? "is not glTF" : firstLine(error));
    return model;
}

}  // namespace diptych::gltf
