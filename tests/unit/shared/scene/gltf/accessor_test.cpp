// SPDX-License-Identifier: MIT
// Every shape, component type, layout and mode of glTF numbers, with values known by hand.
#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/model.h"
#include "tests/support/gltf_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

using namespace diptych;
using Json = nlohmann::json;

namespace {

// A number as a component type stores it: `real` itself for floats; `real` times the largest integer for
// normalized integers.
void append(std::string& data, int type, double real, bool normalized) {
    const auto put = [&](auto value) { data.append(reinterpret_cast<const char*>(&value), sizeof value); };
    const auto integer = [&](auto sample) {
        using T = decltype(sample);
        put(static_cast<T>(normalized ? std::round(real * std::numeric_limits<T>::max()) : real));
    };
    switch (type) {
        case BYTE:
            return integer(std::int8_t{});
        case UBYTE:
            return integer(std::uint8_t{});
        case SHORT:
            return integer(std::int16_t{});
        case USHORT:
            return integer(std::uint16_t{});
        default:
            return put(static_cast<float>(real));
    }
}

std::size_t bytesOf(int type) {
    return type == BYTE || type == UBYTE ? 1 : type == SHORT || type == USHORT ? 2 : 4;
}

// A model with one accessor over the given bytes.
gltf::Model modelOf(const std::string& bytes, int type, int componentType, std::size_t count) {
    gltf::Model model;
    model.buffers.emplace_back().data.assign(bytes.begin(), bytes.end());
    tinygltf::BufferView& view = model.bufferViews.emplace_back();
    view.buffer = 0;
    view.byteLength = bytes.size();
    tinygltf::Accessor& a = model.accessors.emplace_back();
    a.bufferView = 0;
    a.type = type;
    a.componentType = componentType;
    a.count = count;
    return model;
}

}  // namespace

// glTF 2.0, 3.6.2.4: columns begin at multiples of 4 bytes. x is padding; a MAT3 of 9 bytes takes 12.
TEST(GltfAccessor, MatrixColumnsAreAligned) {
    const std::string mat2 = {1, 2, 'x', 'x', 3, 4, 'x', 'x', 5, 6, 'x', 'x', 7, 8};
    gltf::Numbers n = gltf::readNumbers(modelOf(mat2, TINYGLTF_TYPE_MAT2, UBYTE, 2), 0, "test");
    EXPECT_EQ(n.width, 4u);
    EXPECT_EQ(n.values, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
    const std::string mat3 = {1,  2,  3,  'x', 4,  5,  6,  'x', 7,  8,  9, 'x',
                              10, 11, 12, 'x', 13, 14, 15, 'x', 16, 17, 18};
    n = gltf::readNumbers(modelOf(mat3, TINYGLTF_TYPE_MAT3, BYTE, 2), 0, "test");
    EXPECT_EQ(n.width, 9u);
    EXPECT_EQ(n.values[8], 9);
    EXPECT_EQ(n.values[9], 10);
    EXPECT_EQ(n.values[17], 18);
    std::string shorts;
    for (const int v : {1, 2, 3, -1, 4, 5, 6, -1, 7, 8, 9}) append(shorts, SHORT, v, false);
    n = gltf::readNumbers(modelOf(shorts, TINYGLTF_TYPE_MAT3, SHORT, 1), 0, "test");
    EXPECT_EQ(n.values, (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
    std::string floats;
    for (int i = 0; i < 16; ++i) append(floats, FLOAT, i, false);
    n = gltf::readNumbers(modelOf(floats, TINYGLTF_TYPE_MAT4, FLOAT, 1), 0, "test");
    EXPECT_EQ(n.values[15], 15);
    EXPECT_EQ(faultOf([&] { gltf::readNumbers(modelOf(floats, TINYGLTF_TYPE_MAT4, FLOAT, 2), 0, "test"); }),
              "accessor 0: 2 elements of 64 bytes end at 128, past bufferView 0 (64 bytes)");
}

// Elements that an extension decoded, whatever bufferView the accessor names.
TEST(GltfAccessor, DecodedElementsComeFirst) {
    gltf::Model model = modelOf("xxxx", TINYGLTF_TYPE_SCALAR, UBYTE, 2);
    model.decoded_accessors[0] = {3, 4};
    EXPECT_EQ(gltf::readNumbers(model, 0, "test").values, (std::vector<float>{3, 4}));
    model.decoded_accessors[0] = {3};
    EXPECT_EQ(faultOf([&] { gltf::readNumbers(model, 0, "test"); }),
              "accessor 0: 1 bytes are decoded for 2 elements of 1 bytes");
}

// glTF 2.0, 3.11: f = max(c / 127, -1) for signed bytes, c / 255 for unsigned ones, and accordingly for
// shorts.
TEST(GltfAccessor, NormalizedIntegersAreAtLeastMinusOne) {
    const auto numbers = [](int type, std::initializer_list<int> values, bool normalized) {
        std::string bytes;
        for (const int value : values) append(bytes, type, value, false);
        gltf::Model model = modelOf(bytes, TINYGLTF_TYPE_SCALAR, type, values.size());
        model.accessors[0].normalized = normalized;
        return gltf::readNumbers(model, 0, "test").values;
    };
    using Values = std::vector<float>;
    EXPECT_EQ(numbers(BYTE, {-128, -127, -64, 0, 127}, true), (Values{-1, -1, -64 / 127.0f, 0, 1}));
    EXPECT_EQ(numbers(SHORT, {-32768, -32767, 1, 32767}, true), (Values{-1, -1, 1 / 32767.0f, 1}));
    EXPECT_EQ(numbers(UBYTE, {0, 51, 255}, true), (Values{0, 0.2f, 1}));
    EXPECT_EQ(numbers(USHORT, {0, 13107, 65535}, true), (Values{0, 0.2f, 1}));
    EXPECT_EQ(numbers(BYTE, {-128, 127}, false), (Values{-128, 127}));
    EXPECT_EQ(numbers(SHORT, {-32768, 32767}, false), (Values{-32768, 32767}));
}

// Types that KHR_mesh_quantization allows, interleaved: a vertex's attributes are adjacent, from an
// unaligned offset.
TEST(GltfAccessor, EveryAttributeTypeInterleaved) {
    struct Row {
        const char* name;
        const char* shape;
        int type;
        bool normalized;
    };
    std::vector<Row> rows{{"COLOR_0", "VEC3", FLOAT, false}};
    for (const char* name : {"POSITION", "TEXCOORD_0", "TEXCOORD_1"})
        for (const int type : {BYTE, UBYTE, SHORT, USHORT, FLOAT})
            for (const bool normalized : {false, true})
                if (type != FLOAT || !normalized)
                    rows.push_back({name, *name == 'P' ? "VEC3" : "VEC2", type, normalized});
    for (const int type : {BYTE, SHORT, FLOAT}) {
        rows.push_back({"NORMAL", "VEC3", type, type != FLOAT});
        rows.push_back({"TANGENT", "VEC4", type, type != FLOAT});
    }
    for (const char* shape : {"VEC3", "VEC4"})
        for (const int type : {UBYTE, USHORT, FLOAT}) rows.push_back({"COLOR_0", shape, type, type != FLOAT});

    // Values of each vertex; 0 and 1 are exact in every type, normalized or not.
    const double values[3][4] = {{0, 0, 1, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
    for (const Row& row : rows) {
        GltfFile f = GltfFile::triangle();
        f.json["extensionsUsed"] = {"KHR_mesh_quantization"};
        f.data += 'x';
        const std::size_t begin = f.data.size();
        const auto width = static_cast<std::size_t>(row.shape[3] - '0');
        const double normal[4] = {0, 0, 1, 1};
        for (const auto& vertex : values) {
            for (const double v : vertex) append(f.data, FLOAT, v, false);  // padding between the attributes
            for (std::size_t c = 0; c < width; ++c) append(f.data, row.type, vertex[c], row.normalized);
            for (std::size_t c = 0; c < 3; ++c) append(f.data, FLOAT, normal[c], false);
            f.data.resize(begin + (f.data.size() - begin + 3) / 4 * 4, 'x');
        }
        const std::size_t stride = (f.data.size() - begin) / 3;
        f.json["bufferViews"].push_back({{"buffer", 0},
                                         {"byteOffset", begin},
                                         {"byteLength", f.data.size() - begin},
                                         {"byteStride", stride}});
        const std::size_t view = f.json["bufferViews"].size() - 1;
        const auto add = [&](std::size_t offset, int type, const char* shape, bool normalized) {
            f.json["accessors"].push_back({{"bufferView", view},
                                           {"byteOffset", offset},
                                           {"componentType", type},
                                           {"count", 3},
                                           {"type", shape},
                                           {"normalized", normalized}});
            return f.json["accessors"].size() - 1;
        };
        f.primitive()["attributes"]["NORMAL"] = add(16 + width * bytesOf(row.type), FLOAT, "VEC3", false);
        f.primitive()["attributes"][row.name] = add(16, row.type, row.shape, row.normalized);
        const Scene scene = f.load();
        const Primitive& p = f.only(scene);
        const std::string name = row.name;
        ASSERT_EQ(p.positions.size(), 3u);
        for (std::size_t v = 0; v < 3; ++v) {
            const double* e = values[v];
            const std::string where =
                fmt::format("{} {} {} {}, vertex {}", name, row.shape, row.type, row.normalized, v);
            if (name == "POSITION") {
                EXPECT_EQ(p.positions[v], glm::vec3(e[0], e[1], e[2])) << where;
            } else if (name == "NORMAL") {
                EXPECT_EQ(p.normals[v], glm::vec3(e[0], e[1], e[2])) << where;
            } else if (name == "TANGENT") {
                EXPECT_EQ(p.tangents[v], glm::vec4(e[0], e[1], e[2], e[3])) << where;
            } else if (name == "COLOR_0") {
                EXPECT_EQ(p.colors[v], glm::vec4(e[0], e[1], e[2], 1)) << where;
            } else {
                EXPECT_EQ(p.texcoords[name == "TEXCOORD_1"][v], glm::vec2(e[0], e[1])) << where;
            }
            if (name != "NORMAL") {
                EXPECT_EQ(p.normals[v], glm::vec3(0, 0, 1)) << where;
            }
        }
    }
}

// Two triangles of a unit square, in every mode with every index type and without indices.
TEST(GltfAccessor, EveryModeWithEveryIndexType) {
    const std::array<glm::vec3, 4> square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
    const std::vector<int> orders[] = {{0, 1, 2, 0, 2, 3}, {0, 1, 3, 2}, {0, 1, 2, 3}};  // list, strip, fan
    for (const int mode : {4, 5, 6})
        for (const int type : {0, UBYTE, USHORT, UINT})
            for (const bool sparse : {false, true}) {
                GltfFile f = GltfFile::triangle();
                const std::vector<int>& order = orders[mode - 4];
                std::vector<float> positions;
                const auto add = [&](int v) {
                    const glm::vec3& p = square[static_cast<std::size_t>(v)];
                    positions.insert(positions.end(), {p.x, p.y, p.z});
                };
                if (type == 0)
                    for (const int v : order) add(v);
                else
                    for (int v = 0; v < 4; ++v) add(v);
                f.primitive()["attributes"]["POSITION"] = f.accessor(positions, FLOAT, "VEC3", 3);
                f.primitive()["mode"] = mode;
                const auto indices = [&](auto sample) {
                    using T = decltype(sample);
                    const std::vector<T> values(order.begin(), order.end());
                    if (!sparse) return f.accessor(values, type, "SCALAR", 1);
                    // Without a bufferView, all but the sparse elements are zero.
                    std::vector<std::uint8_t> places;
                    for (std::size_t i = 1; i < values.size(); ++i)
                        places.push_back(static_cast<std::uint8_t>(i));
                    const int where = f.accessor(places, UBYTE, "SCALAR", 1);
                    const int what =
                        f.accessor(std::vector<T>(values.begin() + 1, values.end()), type, "SCALAR", 1);
                    f.json["accessors"].push_back(
                        {{"componentType", type},
                         {"count", values.size()},
                         {"type", "SCALAR"},
                         {"sparse",
                          {{"count", places.size()},
                           {"indices", {{"bufferView", where}, {"componentType", UBYTE}}},
                           {"values", {{"bufferView", what}}}}}});
                    return static_cast<int>(f.json["accessors"].size()) - 1;
                };
                if (type)
                    f.primitive()["indices"] = type == UBYTE    ? indices(std::uint8_t{})
                                               : type == USHORT ? indices(std::uint16_t{})
                                                                : indices(std::uint32_t{});
                const Scene scene = f.load();
                const Primitive& p = f.only(scene);
                ASSERT_EQ(p.indices.size(), 6u) << mode << " " << type;
                float area = 0;
                for (std::size_t i = 0; i < 6; i += 3) {
                    const glm::vec3 &a = p.positions[p.indices[i]], &b = p.positions[p.indices[i + 1]],
                                    &c = p.positions[p.indices[i + 2]];
                    area += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
                }
                EXPECT_EQ(area, 1) << mode << " " << type << ": both face +Z and cover the square";
                for (const glm::vec3& v : square)
                    EXPECT_NE(std::find(p.positions.begin(), p.positions.end(), v), p.positions.end());
            }
}

TEST(GltfAccessor, SparseIndicesAscend) {
    for (const auto& [second, fault] : {std::pair{2, ""},
                                        {1, "sparse index 1 does not ascend: 1 after 1"},
                                        {0, "sparse index 1 does not ascend: 0 after 1"}}) {
        GltfFile f = GltfFile::triangle();
        const int where =
            f.accessor<std::uint8_t>({1, static_cast<std::uint8_t>(second)}, UBYTE, "SCALAR", 1);
        const int what = f.accessor<float>({2, 0, 0, 0, 2, 0}, FLOAT, "VEC3", 3);
        f.json["accessors"][0]["sparse"] = {{"count", 2},
                                            {"indices", {{"bufferView", where}, {"componentType", UBYTE}}},
                                            {"values", {{"bufferView", what}}}};
        const std::string error = f.error();
        if (*fault)
            EXPECT_NE(error.find("accessor 0: " + std::string(fault)), std::string::npos) << error;
        else
            EXPECT_EQ(error, "");
    }
}

TEST(GltfAccessor, IndicesFromNothingAreZeros) {
    GltfFile f = GltfFile::triangle();
    f.json["accessors"].push_back({{"componentType", USHORT}, {"count", 6}, {"type", "SCALAR"}});
    f.primitive()["indices"] = f.json["accessors"].size() - 1;
    const Scene scene = f.load();
    for (const glm::vec3& p : f.only(scene).positions) EXPECT_EQ(p, glm::vec3(0));
}

TEST(GltfAccessor, PrimitiveRestartIsRefused) {
    for (const int type : {UBYTE, USHORT, UINT}) {
        GltfFile f = GltfFile::triangle();
        f.primitive()["indices"] = type == UBYTE ? f.accessor<std::uint8_t>({0, 1, 255}, type, "SCALAR", 1)
                                   : type == USHORT
                                       ? f.accessor<std::uint16_t>({0, 1, 65535}, type, "SCALAR", 1)
                                       : f.accessor<std::uint32_t>({0, 1, 4294967295u}, type, "SCALAR", 1);
        const std::string value = type == UBYTE ? "255" : type == USHORT ? "65535" : "4294967295";
        EXPECT_TRUE(f.error().ends_with("mesh 0, primitive 0: indices: index 2 is " + value +
                                        ", the primitive restart value, which glTF forbids"))
            << f.error();
    }
}

TEST(GltfAccessor, TypesThatAnAttributeMayNotHaveAreRefused) {
    const auto ends = [](const std::string& line, const std::string& end) { return line.ends_with(end); };
    GltfFile f = GltfFile::triangle();
    f.primitive()["attributes"]["COLOR_0"] = f.accessor(std::vector<std::uint8_t>(12, 255), UBYTE, "VEC4", 4);
    EXPECT_PRED2(ends, f.error(),
                 "mesh 0, primitive 0: COLOR_0: accessor 1 has integers that are not normalized");
    f = GltfFile::triangle();
    f.primitive()["attributes"]["TEXCOORD_0"] = f.accessor(std::vector<std::uint32_t>(6, 1), UINT, "VEC2", 2);
    EXPECT_PRED2(ends, f.error(),
                 "mesh 0, primitive 0: TEXCOORD_0: accessor 1 has component type 5125, which is not allowed "
                 "for attributes");
}
