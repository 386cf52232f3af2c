// SPDX-License-Identifier: MIT
// EXT_meshopt_compression: streams from the library's own encoder, decoded by the loader.
#include "shared/scene/gltf/compression.h"
#include "shared/scene/gltf/gltf.h"
#include "shared/scene/gltf/model.h"
#include "tests/support/gltf_builder.h"

#include <meshoptimizer.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <random>

using namespace diptych;
using Json = nlohmann::json;

namespace {

using Bytes = std::vector<unsigned char>;

template <class T>
Bytes attributes(const std::vector<T>& values, std::size_t stride) {
    const std::size_t count = values.size() * sizeof(T) / stride;
    Bytes out(meshopt_encodeVertexBufferBound(count, stride));
    out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), values.data(), count, stride));
    return out;
}

Bytes triangles(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    Bytes out(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size()));
    return out;
}

Bytes sequence(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    Bytes out(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
    out.resize(meshopt_encodeIndexSequence(out.data(), out.size(), indices.data(), indices.size()));
    return out;
}

// An accessor over a compressed bufferView of `count` elements. The view is in buffer 1, the fallback.
// Vertices get their stride; indices may have none.
int accessor(GltfFile& f, const Bytes& stream, std::size_t count, std::size_t stride, const char* mode,
             const char* filter, int componentType, const char* type, bool normalized = false) {
    while (f.data.size() % 4) f.data += '\0';
    Json view = {{"buffer", 1},
                 {"byteLength", count * stride},
                 {"extensions",
                  {{"EXT_meshopt_compression",
                    {{"buffer", 0},
                     {"byteOffset", f.data.size()},
                     {"byteLength", stream.size()},
                     {"byteStride", stride},
                     {"count", count},
                     {"mode", mode},
                     {"filter", filter}}}}}};
    if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = stride;
    f.json["bufferViews"].push_back(view);
    f.data.append(stream.begin(), stream.end());
    f.json["accessors"].push_back({{"bufferView", f.json["bufferViews"].size() - 1},
                                   {"componentType", componentType},
                                   {"count", count},
                                   {"type", type},
                                   {"normalized", normalized}});
    f.json["extensionsRequired"] = {"EXT_meshopt_compression"};
    return static_cast<int>(f.json["accessors"].size()) - 1;
}

Json& extensionOf(GltfFile& f, std::size_t view) {
    return f.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"];
}

// Writes the file with its fallback buffer, which has no bytes.
std::string written(GltfFile& f) {
    const std::string file = f.written();
    f.json["buffers"].push_back(
        {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
    std::ofstream(file) << f.declared().dump();
    return file;
}

std::string meshoptLine(GltfFile& f) {
    const std::string file = written(f);
    try {
        loadScene(file);
    } catch (const std::runtime_error& e) {
        return std::string(e.what()).substr(file.size() + 2);
    }
    return "";
}

// A height field of n x n vertices, larger than the encoder's blocks of 256 elements.
struct Grid {
    static constexpr std::uint32_t n = 20;
    // Smooth normals, because flat triangles would split vertices.
    std::vector<float> positions, normals;
    std::vector<std::uint32_t> indices;
    Grid() {
        for (std::uint32_t y = 0; y < n; ++y)
            for (std::uint32_t x = 0; x < n; ++x) {
                const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
                positions.insert(positions.end(), {fx, fy, 0.37f * std::sin(fx * 0.7f + fy)});
                normals.insert(normals.end(), {0, 0, 1});
                const std::uint32_t v = y * n + x;
                if (x + 1 < n && y + 1 < n)
                    indices.insert(indices.end(), {v, v + 1, v + n, v + 1, v + n + 1, v + n});
            }
    }
    std::size_t vertices() const { return positions.size() / 3; }
};

GltfFile compressedTriangle() {
    GltfFile f = GltfFile::triangle();
    f.primitive()["attributes"]["POSITION"] = accessor(f, attributes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 12),
                                                       3, 12, "ATTRIBUTES", "NONE", FLOAT, "VEC3");
    f.primitive()["indices"] =
        accessor(f, triangles({0, 1, 2}, 3), 3, 4, "TRIANGLES", "NONE", UINT, "SCALAR");
    return f;
}

}  // namespace

TEST(GltfMeshopt, PositionsAndTrianglesAreThoseOfTheUncompressedFile) {
    const Grid grid;
    GltfFile plain = GltfFile::triangle();
    plain.primitive()["attributes"]["POSITION"] = plain.accessor(grid.positions, FLOAT, "VEC3", 3);
    plain.primitive()["attributes"]["NORMAL"] = plain.accessor(grid.normals, FLOAT, "VEC3", 3);
    plain.primitive()["indices"] = plain.accessor(grid.indices, UINT, "SCALAR", 1);
    const Scene expected = plain.load();
    for (const std::size_t width : {2, 4}) {
        GltfFile f = GltfFile::triangle();
        f.primitive()["attributes"]["POSITION"] = accessor(f, attributes(grid.positions, 12), grid.vertices(),
                                                           12, "ATTRIBUTES", "NONE", FLOAT, "VEC3");
        f.primitive()["attributes"]["NORMAL"] = f.accessor(grid.normals, FLOAT, "VEC3", 3);
        f.primitive()["indices"] = accessor(f, triangles(grid.indices, grid.vertices()), grid.indices.size(),
                                            width, "TRIANGLES", "NONE", width == 2 ? USHORT : UINT, "SCALAR");
        const Scene scene = loadScene(written(f));
        EXPECT_EQ(f.only(scene).positions, plain.only(expected).positions);
        ASSERT_EQ(f.only(scene).indices.size(), grid.indices.size());
        // The encoder may rotate a triangle's corners, but keeps their cyclic order.
        for (std::size_t i = 0; i < grid.indices.size(); i += 3) {
            std::vector<std::uint32_t> t(&f.only(scene).indices[i], &f.only(scene).indices[i] + 3);
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
            // Rotated to begin with the smallest.
            const std::vector<std::uint32_t> e(&grid.indices[i], &grid.indices[i] + 3);
            EXPECT_EQ(t, e) << "triangle " << i / 3;
        }
    }
}

TEST(GltfMeshopt, IndicesOfAStripKeepTheirOrder) {
    for (const std::size_t width : {2, 4}) {
        GltfFile f = GltfFile::triangle();
        f.primitive()["attributes"]["POSITION"] =
            f.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, FLOAT, "VEC3", 3);
        f.primitive()["attributes"]["NORMAL"] =
            f.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, FLOAT, "VEC3", 3);
        f.primitive()["mode"] = 5;
        f.primitive()["indices"] = accessor(f, sequence({0, 1, 2, 3}, 4), 4, width, "INDICES", "NONE",
                                            width == 2 ? USHORT : UINT, "SCALAR");
        const Scene scene = loadScene(written(f));
        EXPECT_EQ(f.only(scene).indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    }
}

// Unit vectors at the octahedron's corners are exact; (0.6, 0, 0.8) is between two codes.
TEST(GltfMeshopt, OctahedralNormalsOf8And16Bits) {
    const std::vector<float> normals{0, 0, 1, 0, 0, -1, 0, 0, 0.6f, 0, 0.8f, 0};
    for (const std::size_t stride : {4, 8}) {
        GltfFile f = GltfFile::triangle();
        Bytes filtered(3 * stride);
        const int bits = stride == 4 ? 8 : 16;
        meshopt_encodeFilterOct(filtered.data(), 3, stride, bits, normals.data());
        f.primitive()["attributes"]["NORMAL"] =
            accessor(f, attributes(filtered, stride), 3, stride, "ATTRIBUTES", "OCTAHEDRAL",
                     stride == 4 ? BYTE : SHORT, "VEC3", true);
        const Scene scene = loadScene(written(f));
        const auto& read = f.only(scene).normals;
        const float step = 1.0f / static_cast<float>((1 << (bits - 1)) - 1);  // of the encoding
        for (std::size_t v = 0; v < 3; ++v)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(read[v][c], normals[4 * v + static_cast<std::size_t>(c)], v < 2 ? 1e-6f : step)
                    << "vertex " << v << ", " << bits << " bits";
    }
}

// The exponential filter: a signed 8-bit exponent above a signed 24-bit mantissa
// (EXT_meshopt_compression).
TEST(GltfMeshopt, ExponentialPositions) {
    GltfFile f = GltfFile::triangle();
    const std::vector<float> positions{0, 0, 0, 1.5f, 0, 0, 0, -1024, 0.25f};
    std::vector<std::uint32_t> filtered;
    for (const float p : positions)  // all are multiples of 2^-2
        filtered.push_back(0xfeu << 24 | (static_cast<std::uint32_t>(static_cast<int>(p * 4)) & 0xffffffu));
    f.primitive()["attributes"]["POSITION"] =
        accessor(f, attributes(filtered, 12), 3, 12, "ATTRIBUTES", "EXPONENTIAL", FLOAT, "VEC3");
    const Scene scene = loadScene(written(f));
    EXPECT_EQ(f.only(scene).positions, (std::vector<glm::vec3>{{0, 0, 0}, {1.5f, 0, 0}, {0, -1024, 0.25f}}));
}

// Rotations as shorts: half a step of 1/sqrt(2)/32767 and rounding to integers stay within 2.
TEST(GltfMeshopt, Quaternions) {
    const float h = std::sqrt(0.5f);
    const std::vector<float> rotations{0, 0, 0, 1, h, 0, 0, h, 0.5f, -0.5f, 0.5f, 0.5f};
    Bytes filtered(3 * 8);
    meshopt_encodeFilterQuat(filtered.data(), 3, 8, 16, rotations.data());
    gltf::Model model;
    model.buffers.emplace_back().data = attributes(filtered, 8);
    tinygltf::BufferView& view = model.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteLength = 24;
    model.rest["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = {
        {"buffer", 0},          {"byteLength", model.buffers[0].data.size()},
        {"byteStride", 8},      {"count", 3},
        {"mode", "ATTRIBUTES"}, {"filter", "QUATERNION"}};
    std::vector<std::string> notes;
    std::map<std::size_t, std::string> broken;
    gltf::decompress(model, {}, broken, notes);
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(model.buffers.size(), 1u);
    const std::vector<unsigned char>& decoded = model.decoded_views.at(0).bytes;
    ASSERT_EQ(decoded.size(), 24u);
    std::int16_t read[12];
    std::memcpy(read, decoded.data(), sizeof read);
    for (std::size_t q = 0; q < 3; ++q) {
        // q and -q are the same rotation.
        const float sign =
            std::signbit(rotations[4 * q + 3]) != std::signbit(float(read[4 * q + 3])) ? -1 : 1;
        for (std::size_t c = 0; c < 4; ++c)
            EXPECT_NEAR(sign * read[4 * q + c], rotations[4 * q + c] * 32767, 2) << q << ", " << c;
    }
}

TEST(GltfMeshopt, WhatIsWrongIsSaidInOneLine) {
    struct Fault {
        const char* line;
        std::function<void(GltfFile&)> change;
    };
    const auto set = [](std::size_t view, const char* key, Json value) {
        return [=](GltfFile& f) { extensionOf(f, view)[key] = value; };
    };
    // View 0 is not compressed, view 1 contains positions, view 2 indices.
    const Fault faults[] = {
        {"bufferView 1: EXT_meshopt_compression: byteStride 6, not a multiple of 4 up to 256",
         set(1, "byteStride", 6)},
        {"bufferView 1: EXT_meshopt_compression: byteStride 16, but the bufferView's is 12",
         set(1, "byteStride", 16)},
        {"bufferView 1: EXT_meshopt_compression: 4 elements of 12 bytes, but the bufferView has 36 bytes",
         set(1, "count", 4)},
        {"bufferView 1: EXT_meshopt_compression: has no elements", set(1, "count", 0)},
        {"bufferView 1: EXT_meshopt_compression: byteStride 12, not 4 or 8", set(1, "filter", "OCTAHEDRAL")},
        {"bufferView 1: EXT_meshopt_compression: byteStride 12, not 8", set(1, "filter", "QUATERNION")},
        {"bufferView 2: EXT_meshopt_compression: byteStride 8, not 2 or 4", set(2, "byteStride", 8)},
        {"bufferView 2: EXT_meshopt_compression: indices must not have a filter",
         set(2, "filter", "EXPONENTIAL")},
        {"bufferView 2: EXT_meshopt_compression: 4 indices are not a multiple of 3", set(2, "count", 4)},
        {"bufferView 2: EXT_meshopt_compression: 5 bytes are too few for 3 elements",
         set(2, "byteLength", 5)},
        {"bufferView 1: EXT_meshopt_compression: 999 bytes at offset 36 end past buffer 0 (122 bytes)",
         set(1, "byteLength", 999)},
        {"bufferView 1: EXT_meshopt_compression: buffer 1: has no data: it is a fallback for readers without "
         "EXT_meshopt_compression",
         set(1, "buffer", 1)},
        {"bufferView 2: EXT_meshopt_compression: its data has another mode", set(2, "mode", "INDICES")},
        {"bufferView 1: EXT_meshopt_compression: its data has another mode",
         [](GltfFile& f) { f.data[36] = '\x77'; }},
        {"buffer 1: has no data: it is a fallback for readers without EXT_meshopt_compression",
         erases("/bufferViews/1", "extensions")},
    };
    for (const Fault& fault : faults) {
        GltfFile f = compressedTriangle();
        ASSERT_EQ(meshoptLine(f), "");
        f = compressedTriangle();
        fault.change(f);
        EXPECT_EQ(meshoptLine(f), fault.line);
    }
}

TEST(GltfMeshopt, StreamsThatAreTooShortOrTooLong) {
    const Bytes stream = attributes(Grid().positions, 12);
    for (const int change : {-1, 1}) {
        GltfFile f = GltfFile::triangle();
        Bytes other = stream;
        other.resize(static_cast<std::size_t>(static_cast<int>(stream.size()) + change));
        f.primitive()["attributes"]["POSITION"] =
            accessor(f, other, Grid().vertices(), 12, "ATTRIBUTES", "NONE", FLOAT, "VEC3");
        EXPECT_EQ(meshoptLine(f),
                  "bufferView 1: EXT_meshopt_compression: its data has the wrong length for its elements")
            << change;
    }
}

// A thousand views of one stream would decode to a thousand times its size.
TEST(GltfMeshopt, OneStreamForManyViewsIsBounded) {
    GltfFile f = GltfFile::triangle();
    const std::size_t count = 1 << 18;
    accessor(f, attributes(std::vector<float>(3 * count), 12), count, 12, "ATTRIBUTES", "NONE", FLOAT,
             "VEC3");
    const Json view = f.json["bufferViews"].back();
    for (int i = 0; i < 1000; ++i) f.json["bufferViews"].push_back(view);
    EXPECT_EQ(
        meshoptLine(f).find("its compressed geometry claims 3148873728 bytes; the limit for buffers of "),
        0u);
}

// Damaged streams give a scene or a one-line error; AddressSanitizer checks memory.
TEST(GltfMeshopt, DamagedStreamsAreSceneOrLine) {
    const Grid grid;
    GltfFile f = GltfFile::triangle();
    f.data.clear();
    f.json.erase("bufferViews");
    f.json.erase("accessors");
    f.primitive()["attributes"]["POSITION"] =
        accessor(f, attributes(grid.positions, 12), grid.vertices(), 12, "ATTRIBUTES", "NONE", FLOAT, "VEC3");
    f.primitive()["indices"] = accessor(f, triangles(grid.indices, grid.vertices()), grid.indices.size(), 2,
                                        "TRIANGLES", "NONE", USHORT, "SCALAR");
    for (Json& view : f.json["bufferViews"]) view["buffer"] = 0;  // a .glb without a second buffer
    const std::string binary = f.binary();
    const std::size_t begin = binary.size() - f.data.size();
    std::mt19937 random(5);
    int scenes = 0, lines = 0;
    for (int i = 0; i < 600; ++i) {
        Bytes bytes(binary.begin(), binary.end());
        for (auto flips = 1 + random() % 3; flips > 0; --flips)
            bytes[begin + random() % f.data.size()] ^= static_cast<unsigned char>(1u << random() % 8);
        try {
            parseGltf(std::move(bytes), "damaged");
            ++scenes;
        } catch (const std::runtime_error& e) {
            EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
            ++lines;
        }
    }
    EXPECT_GT(scenes, 0);
    EXPECT_GT(lines, 0);
}
