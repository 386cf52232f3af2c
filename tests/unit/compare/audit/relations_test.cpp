// SPDX-License-Identifier: MIT
// Metamorphic relations: whether they apply where they should, and change what they say.
#include "compare/audit/relations.h"
#include "compare/audit/relate.h"
#include "compare/audit/report.h"
#include "compare/audit/small_scene.h"
#include "compare/output/writers.h"
#include "shared/scene/gltf/gltf.h"
#include "tests/support/errors.h"
#include "tests/support/plain_builtin.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <set>

namespace diptych::audit {

namespace {

Subject related(const std::string& scene, Settings settings = {}) {
    settings.size = {32, 18};
    settings.shadows = Shadows::off;
    return makeSubject(plainBuiltin(scene), settings);
}

const Relation& relationOf(const std::string& name) {
    return *relationsOf(std::array{name}).front();
}

Related changedBy(const std::string& name, const Subject& subject) {
    Related both{subject.original, subject.original};
    relationOf(name).change(both, subject);
    return both;
}

}  // namespace

TEST(Relations, EachChangesSomethingOrSaysWhyNot) {
    EXPECT_GE(relations().size(), 12u);
    std::set<std::string_view> names;
    const Subject subject = related("gallery");
    const std::string original = glbOf(*flattened(subject.original));
    const auto vertices = [](const Case& of) {
        std::size_t count = 0;
        for (const Mesh& mesh : of.scene.meshes)
            for (const Primitive& primitive : mesh.primitives) count += primitive.positions.size();
        return count;
    };
    for (const Relation& relation : relations()) {
        EXPECT_TRUE(names.insert(relation.name).second) << relation.name;
        EXPECT_FALSE(relation.because.empty()) << relation.name;
        EXPECT_EQ(relation.lacks(subject), "") << relation.name;
        Related both{subject.original, subject.original};
        relation.change(both, subject);
        if (relation.name == "repeated") continue;
        const bool same =
            both.base.settings == both.changed.settings &&
            lightsFileOf(both.base) == lightsFileOf(both.changed) &&
            both.base.scene.nodes.size() == both.changed.scene.nodes.size() &&
            vertices(both.base) == vertices(both.changed) &&
            both.base.scene.materials.front().name == both.changed.scene.materials.front().name &&
            relation.name != "through_glb" && glbOf(*flattened(both.base)) == glbOf(*flattened(both.changed));
        EXPECT_FALSE(same) << relation.name;
        const bool own = both.base.settings != subject.original.settings ||
                         both.base.scene.images.size() != subject.original.scene.images.size() ||
                         glbOf(*flattened(both.base)) != original;
        EXPECT_TRUE(!own || both.own_base) << relation.name;
    }
}

TEST(Relations, WhatDoesNotApplyIsSaid) {
    const auto lacks = [](const std::string& name, const Subject& subject) {
        return relationOf(name).lacks(subject);
    };
    EXPECT_NE(lacks("still_time", related("motion")), "");
    for (const char* name : {"through_gltf", "through_glb"})
        EXPECT_EQ(
            lacks(name, related("motion")),
            "joints, morph targets or a rotated normal map move vertices, and the written file leaves them "
            "out");
    EXPECT_NE(lacks("lights_permuted", related("triangle")), "");
    Settings settings;
    settings.assign = Assignment::per_object;
    EXPECT_NE(lacks("lights_split", related("gallery", settings)), "");
    EXPECT_NE(lacks("assign_tiled", related("gallery", settings)), "");
    settings.assign = Assignment::every;
    EXPECT_NE(lacks("light_kernel", related("gallery", settings)), "");
    Subject shadowed = related("gallery");
    shadowed.original.settings.shadows = Shadows::pcf;
    for (const char* name : {"moved", "turned", "mirrored", "scaled", "tiles_shifted", "near_halved"})
        EXPECT_NE(lacks(name, shadowed), "") << name;
    Subject odd = related("gallery");
    odd.view.width = 31;
    EXPECT_NE(lacks("mirrored", odd), "");
}

// Nodes scale thicknesses; a volume absorbs the same over twice the length.
TEST(Relations, ScalingKeepsWhatAVolumeAbsorbs) {
    const Subject subject = related("transmission");
    const Related scaled = changedBy("scaled", subject);
    const std::vector<Material>&before = scaled.base.scene.materials, &after = scaled.changed.scene.materials;
    bool any = false;
    for (std::size_t i = 0; i < before.size(); ++i) {
        any = any || before[i].attenuation_distance > 0;
        EXPECT_EQ(after[i].attenuation_distance, 2 * before[i].attenuation_distance);
        EXPECT_EQ(after[i].thickness, before[i].thickness);
    }
    EXPECT_TRUE(any);
    EXPECT_NE(relationOf("tiles_shifted").lacks(subject), "") << "blurred light depends on the border";
}

TEST(Relations, LightIsSplitPermutedAndAddedAsItSays) {
    const Subject subject = related("gallery");
    const auto total = [](const Case& of) {
        double sum = 0;
        for (const Light& light : of.scene.lights) sum += light.intensity;
        return sum;
    };
    const double all = total(subject.original);
    const Related split = changedBy("lights_split", subject);
    EXPECT_EQ(split.changed.scene.lights.size(), 2 * subject.original.scene.lights.size());
    EXPECT_EQ(total(split.changed), all);
    const Related permuted = changedBy("lights_permuted", subject);
    EXPECT_EQ(permuted.changed.scene.lights.size(), subject.original.scene.lights.size());
    EXPECT_EQ(permuted.changed.scene.lights.front().position, subject.original.scene.lights.back().position);
    EXPECT_EQ(total(changedBy("light_doubled", subject).changed), 2 * all);
    EXPECT_EQ(total(changedBy("dark_lights", subject).changed), all);
    const Related far = changedBy("far_lights", subject);
    for (std::size_t i = 0; i < 3; ++i) {
        const Light& light = far.changed.scene.lights[i];
        EXPECT_GT(glm::distance(light.position, subject.bounds.centre()),
                  subject.bounds.radius() + double{light.range});
        EXPECT_GT(glm::distance(light.position, subject.view.eye()), double{light.range});
    }
}

// Corners of all nodes' triangles, in the space of their mesh.
std::multiset<std::vector<float>> trianglesOf(const Scene& scene) {
    std::multiset<std::vector<float>> all;
    for (const Node& node : scene.nodes) {
        if (node.mesh < 0) continue;
        for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives)
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                std::vector<float> corners;
                for (std::size_t k = 0; k < 3; ++k)
                    for (int c = 0; c < 3; ++c)
                        corners.push_back(primitive.positions[primitive.indices[i + k]][c]);
                all.insert(std::move(corners));
            }
    }
    return all;
}

TEST(Relations, GeometryIsTheSameWrittenOtherwise) {
    const Subject subject = related("gallery");
    const std::size_t triangles = triangleCount(flattened(subject.original)->scene);
    const auto before = trianglesOf(subject.original.scene);
    for (const char* name : {"draws_reversed", "meshes_split", "unindexed", "materials_permuted"})
        EXPECT_TRUE(trianglesOf(changedBy(name, subject).changed.scene) == before) << name;
    EXPECT_GT(triangleCount(flattened(changedBy("triangles_split", subject).changed)->scene), triangles);
    const Related moved = changedBy("moved", subject);
    EXPECT_GT(glm::length(glm::dvec3(moved.changed.camera().world_from_camera[3])),
              1e4 * subject.bounds.radius());
}

TEST(Relations, TwoFilesOfOneSceneAreRead) {
    const Subject subject = related("gallery");
    const Case flat = *flattened(subject.original);
    const std::string text = gltfOf(flat), binary = glbOf(flat);
    EXPECT_EQ(binary.substr(0, 4), "glTF");
    EXPECT_EQ(binary.size() % 4, 0u);
    const Scene a = parseGltf({text.begin(), text.end()}, "a.gltf"),
                b = parseGltf({binary.begin(), binary.end()}, "a.glb");
    ASSERT_EQ(a.meshes.size(), b.meshes.size());
    for (std::size_t m = 0; m < a.meshes.size(); ++m) {
        const Primitive &p = a.meshes[m].primitives.front(), &q = b.meshes[m].primitives.front();
        EXPECT_EQ(p.positions, q.positions);
        EXPECT_EQ(p.normals, q.normals);
        EXPECT_EQ(p.indices, q.indices);
    }
    const std::vector<int> order = writtenMaterials(flat.scene);
    ASSERT_EQ(a.materials.size(), order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        EXPECT_EQ(a.materials[i].name, flat.scene.materials[static_cast<std::size_t>(order[i])].name);
}

TEST(Relations, TheReferenceTellsWhoseFaultItIs) {
    const auto series = [](Path path, bool holds) {
        SeriesResult of;
        of.series.path = path;
        ChannelResult channel;
        channel.beyond = holds ? 0 : 1;
        of.comparison.channels.push_back(channel);
        return of;
    };
    RelationResult result;
    result.relation = &relations().front();
    result.series = {series(Path::deferred, true), series(Path::forward_plus, false),
                     series(Path::reference, true)};
    EXPECT_FALSE(result.passes());
    const ReportDevice gpu{"Some GPU", "driver 1.2", "discrete"};
    for (const std::string& sentence :
         {output::inText(blocksOf(result, gpu)), output::inHtml(blocksOf(result, gpu))})
        for (const char* told : {"broken", "a bug of the driver or of Diptych, on Some GPU with driver 1.2",
                                 "forward_plus: broken", "forward_plus, lit: 1 pixel out of tolerance"})
            EXPECT_NE(sentence.find(told), sentence.npos) << sentence;
    EXPECT_NE(blameText(result, {"llvmpipe", "Mesa", "cpu"}).find("most likely a bug of Diptych"),
              std::string::npos);
    result.series[2] = series(Path::reference, false);
    EXPECT_NE(blameText(result, gpu).find("the double-precision reference breaks it too"), std::string::npos);
    result.series[1] = series(Path::forward_plus, true);
    EXPECT_TRUE(result.passes()) << "the reference only tells whose fault it is";
    EXPECT_EQ(blameText(result, gpu), "");
    result.series[1].comparison.failed = "no memory";
    EXPECT_FALSE(result.passes());
}

TEST(Relations, ThePageHeadsEachWithItsVerdict) {
    SeriesResult drawn;
    drawn.series.path = Path::deferred;
    const RelationResult moved{relationsOf(std::array{std::string("moved")}).front(), "", {drawn}};
    const std::string page = output::inHtml(blocksOf(moved, {}));
    EXPECT_NE(page.find("<h3>moved <span class=\"verdict pass\">holds</span></h3>"), page.npos) << page;
    EXPECT_EQ(output::inText(blocksOf(moved, {})), "moved               holds: equal\n");
}

TEST(Relations, AnUnknownNameIsRefused) {
    const std::string refusal = faultOf([&] { relationsOf(std::array{std::string("mirored")}); });
    EXPECT_NE(refusal.find("--relation mirored: there is no such relation; did you mean mirrored?"),
              std::string::npos)
        << refusal;
    EXPECT_EQ(relationsOf({}).size(), relations().size());
}

}  // namespace diptych::audit
