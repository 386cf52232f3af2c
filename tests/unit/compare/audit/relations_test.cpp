// SPDX-License-Identifier: MIT
// Metamorphic relations: whether they apply where they should, and whether allowed and forbidden image
// differences are told apart.
#include "compare/audit/relations.h"
#include "compare/audit/relate.h"
#include "compare/audit/report.h"
#include "compare/audit/small_scene.h"
#include "compare/output/writers.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/builtin/builtin.h"
#include "shared/scene/gltf/gltf.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace diptych::audit {

namespace {

constexpr int relatedWidth = 16, relatedHeight = 8;

// Without a sheen and a film: two walls, of material 0 on the left at 2 m and of material 1 on the right at 3
// m, lit evenly.
Frame twoWalls() {
    Frame frame;
    frame.settings.size = {relatedWidth, relatedHeight};
    for (const Channel mode : relatedChannels())
        frame.channels[mode] = Image(relatedWidth, relatedHeight, debugMode(mode).width, 0.5f);
    for (int y = 0; y < relatedHeight; ++y)
        for (int x = 0; x < relatedWidth; ++x) {
            const bool right = x >= relatedWidth / 2;
            frame.channels[Channel::material_id].at(x, y) = right ? 1.0f : 0.0f;
            frame.channels[Channel::depth].at(x, y) = right ? 3.0f : 2.0f;
            for (const Channel mode : {Channel::normals, Channel::geometric_normal})
                for (int c = 0; c < 3; ++c) frame.channels[mode].at(x, y, c) = c == 2 ? 1.0f : 0.0f;
        }
    for (const Channel mode : {Channel::sheen_color, Channel::sheen_roughness, Channel::iridescence,
                               Channel::iridescence_thickness})
        std::ranges::fill(frame.channels.at(mode).data, 0.0f);
    return frame;
}

RelationTolerance toleranceFor(Equality equality) {
    RelationTolerance tolerance;
    tolerance.equality = equality;
    if (equality != Equality::bits) tolerance.relative = 1e-6;
    if (equality == Equality::rounding) tolerance.step = 0x1p-7;
    return tolerance;
}

// Turns a normal of two walls, and changes its light by `slope` times as much.
bool passesTurned(const Frame& original, double slope) {
    Frame changed = original;
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.relative = 1e-5;
    changed.channels[Channel::normals].at(2, 3, 0) = 0.9e-5f;
    changed.channels[Channel::lit].at(2, 3, 0) *= static_cast<float>(1 + slope * 0.9e-5);
    return evaluate(original, changed, tolerance).passes();
}

float above(float value, int ulps = 1) {
    for (int i = 0; i < ulps; ++i) value = std::nextafter(value, 10.0f);
    return value;
}

// Built once: a gallery's textures take half a second.
const Scene& relatedBuiltin(const std::string& name) {
    static std::map<std::string, Scene> made;
    const auto found = made.find(name);
    return found != made.end() ? found->second : made.emplace(name, makeBuiltin(name)).first->second;
}

Subject related(const std::string& scene, Settings settings = {}) {
    settings.size = {32, 18};
    settings.shadows = Shadows::off;
    return makeSubject(relatedBuiltin(scene), settings);
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

TEST(Relations, BitsAreTheSameOrNot) {
    const Frame original = twoWalls();
    EXPECT_TRUE(evaluate(original, original, toleranceFor(Equality::bits)).passes());
    EXPECT_EQ(evaluate(original, original, toleranceFor(Equality::bits)).worst(), nullptr);
    for (const Channel mode : relatedChannels()) {
        Frame changed = original;
        float& value = changed.channels[mode].at(3, 2, debugMode(mode).width - 1);
        value = above(value);
        const FrameResult result = evaluate(original, changed, toleranceFor(Equality::bits));
        EXPECT_FALSE(result.passes()) << debugMode(mode).name;
        ASSERT_NE(result.worst(), nullptr);
        EXPECT_EQ(result.worst()->mode, mode);
        EXPECT_EQ(result.worst()->x, 3);
        EXPECT_EQ(result.worst()->y, 2);
        EXPECT_EQ(result.worst()->beyond, 1u);
    }
}

TEST(Relations, OtherPipelinesMayRoundOtherwiseOnAGpu) {
    const Frame original = twoWalls();
    RelationTolerance tolerance = toleranceFor(Equality::bits);
    tolerance.ulps = 16;
    Frame changed = original;
    float& value = changed.channels[Channel::lit].at(3, 2, 1);
    value = above(value, 16);
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    EXPECT_EQ(evaluate(original, changed, tolerance).worst()->error, 16);
    value = above(value);
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
}

// Light of a coat moves with the coat's own normal.
TEST(Relations, ACoatsNormalMovesLight) {
    Frame original = twoWalls();
    original.channels[Channel::clearcoat_normal] = original.channels[Channel::normals];
    Frame changed = original;
    changed.channels[Channel::lit].at(3, 2, 0) *= 1 + 1e-4f;
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.relative = 2e-5;  // of the normal
    changed.channels[Channel::clearcoat_normal].at(3, 2, 0) = 1e-5f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    for (Frame* frame : {&original, &changed}) frame->channels.erase(Channel::clearcoat_normal);
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes()) << "without a coat";
}

// The base's lobe grants 12 times the normal's rotation, a sheen of roughness 0.1 204 times more.
TEST(Relations, ASheensLightMovesWithTheNormal) {
    Frame original = twoWalls();
    std::ranges::fill(original.channels[Channel::sheen_roughness].data, 0.1f);
    EXPECT_FALSE(passesTurned(original, 200)) << "a sheen without colour is none";
    std::ranges::fill(original.channels[Channel::sheen_color].data, 0.5f);
    EXPECT_TRUE(passesTurned(original, 200));
    EXPECT_FALSE(passesTurned(original, 230));
    // No sheen is smoother than 0.045.
    std::ranges::fill(original.channels[Channel::sheen_roughness].data, 0.0f);
    EXPECT_TRUE(passesTurned(original, 900));
    EXPECT_FALSE(passesTurned(original, 1100));
}

TEST(Relations, AFilmsLightMovesWithTheNormal) {
    Frame original = twoWalls();
    EXPECT_FALSE(passesTurned(original, 35));
    std::ranges::fill(original.channels[Channel::iridescence].data, 0.5f);
    EXPECT_TRUE(passesTurned(original, 35));
    EXPECT_FALSE(passesTurned(original, 60));
}

// A half's rounding of a thickness is relative to it.
TEST(Relations, APackedThicknessIsGrantedItsPart) {
    Frame original = twoWalls();
    std::ranges::fill(original.channels[Channel::iridescence_thickness].data, 400.0f);
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.packed[Channel::iridescence_thickness] = 0x1p-11;
    Frame changed = original;
    changed.channels[Channel::iridescence_thickness].at(3, 2, 0) += 0.9f * 2 * 400 * 0x1p-11f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    changed.channels[Channel::iridescence_thickness].at(3, 2, 0) += 0.2f * 2 * 400 * 0x1p-11f;
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
}

TEST(Relations, SumsAreGrantedByComponent) {
    Frame original = twoWalls();
    original.channels[Channel::lit].at(5, 5, 2) = 1e-6f;
    Frame changed = original;
    changed.channels[Channel::lit].at(3, 2, 0) *= 1 + 5e-7f;
    EXPECT_TRUE(evaluate(original, changed, toleranceFor(Equality::sums)).passes());
    // Small for the pixel, but large for its blue component.
    changed.channels[Channel::lit].at(5, 5, 2) = 1.1e-6f;
    const FrameResult result = evaluate(original, changed, toleranceFor(Equality::sums));
    EXPECT_FALSE(result.passes());
    EXPECT_EQ(result.worst()->x, 5);
    // Surface channels are not sums of light.
    changed = original;
    changed.channels[Channel::albedo].at(3, 2, 0) = above(0.5f);
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::sums)).passes());
}

TEST(Relations, RoundingIsGrantedByWhatChangesToTheNextPixel) {
    Frame original = twoWalls();
    for (int y = 0; y < relatedHeight; ++y) original.channels[Channel::lit].at(4, y, 0) = 0.6f;
    Frame changed = original;
    changed.channels[Channel::lit].at(4, 3, 0) += 0.9f * 0.1f * 0x1p-7f;
    EXPECT_TRUE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
    changed.channels[Channel::lit].at(4, 3, 0) += 0.2f * 0.1f * 0x1p-7f;
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
    // No tolerance where neighbouring pixels are equal.
    changed = original;
    changed.channels[Channel::lit].at(1, 3, 0) += 0.9f * 0.1f * 0x1p-7f;
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
}

TEST(Relations, LightFollowsANormalAsFastAsItsLobe) {
    const Frame original = twoWalls();
    Frame changed = original;
    // Roughness 0.5, alpha 0.25: light may change by 12 times the normal's rotation.
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.relative = 1e-5;
    changed.channels[Channel::normals].at(2, 3, 0) = 0.9e-5f;
    changed.channels[Channel::lit].at(2, 3, 0) *= 1 + 11 * 0.9e-5f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    changed.channels[Channel::lit].at(2, 3, 0) *= 1 + 5 * 0.9e-5f;
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
}

TEST(Relations, AnotherSurfaceIsSetAsideBesideAnEdgeAlone) {
    const Frame original = twoWalls();
    const auto shows = [&](int x, int y) {
        Frame changed = original;
        changed.channels[Channel::material_id].at(x, y) = 1;
        changed.channels[Channel::depth].at(x, y) = 3;
        changed.channels[Channel::lit].at(x, y, 0) = 0.9f;
        return changed;
    };
    const FrameResult beside =
        evaluate(original, shows(relatedWidth / 2 - 1, 3), toleranceFor(Equality::rounding));
    EXPECT_TRUE(beside.passes());
    EXPECT_EQ(beside.aside, 1u);
    EXPECT_EQ(beside.max_aside, 8u) << "of few edges";
    // In the middle of a wall the changed pixel makes its own edge, but the given image has none there.
    EXPECT_FALSE(evaluate(original, shows(2, 3), toleranceFor(Equality::rounding)).passes());
    // A whole column exceeds the allowed number of pixels.
    Frame changed = original;
    for (int y = 0; y < relatedHeight; ++y)
        for (const int x : {relatedWidth / 2 - 1, relatedWidth / 2})
            changed.channels[Channel::material_id].at(x, y) =
                1 - original.channels.at(Channel::material_id).at(x, y);
    EXPECT_GT(evaluate(original, changed, toleranceFor(Equality::rounding)).aside, 8u);
    EXPECT_FALSE(evaluate(original, changed, toleranceFor(Equality::rounding)).passes());
    // Bitwise equality has no tolerance at edges.
    EXPECT_FALSE(evaluate(original, shows(relatedWidth / 2 - 1, 3), toleranceFor(Equality::bits)).passes());
}

TEST(Relations, OfOneDepthEitherSurfaceMayBeSeen) {
    const Frame original = twoWalls();
    RelationTolerance tolerance = toleranceFor(Equality::bits);
    tolerance.reorders = true;
    Frame changed = original;
    changed.channels[Channel::material_id].at(2, 3) = 1;
    changed.channels[Channel::lit].at(2, 3, 0) = 0.9f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    EXPECT_EQ(evaluate(original, changed, tolerance).aside, 1u);
    changed.channels[Channel::depth].at(2, 3) = 1.5f;
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
    // The same surface must have the same light.
    changed = original;
    changed.channels[Channel::lit].at(2, 3, 0) = 0.9f;
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes());
}

TEST(Relations, AFilterMayWeightOtherwiseOfFewPixels) {
    const Frame original = twoWalls();
    RelationTolerance tolerance = toleranceFor(Equality::rounding);
    tolerance.textured = {true, false};
    tolerance.filter_step = 0x1p-7;
    Frame changed = original;
    changed.channels[Channel::albedo].at(2, 3, 1) += 0x1p-8f;
    changed.channels[Channel::lit].at(2, 3, 1) += 0x1p-8f;
    EXPECT_TRUE(evaluate(original, changed, tolerance).passes());
    EXPECT_EQ(evaluate(original, changed, tolerance).filtered, 1u);
    Frame wrong = changed;
    wrong.channels[Channel::albedo].at(2, 3, 1) += 0.25f;
    EXPECT_FALSE(evaluate(original, wrong, tolerance).passes()) << "its light alone is excused";
    Frame more = original;
    for (int y = 0; y < relatedHeight; ++y)
        for (int x = 0; x < 2; ++x) more.channels[Channel::albedo].at(x, y, 1) += 0x1p-8f;
    EXPECT_FALSE(evaluate(original, more, tolerance).passes());
    tolerance.textured = {false, false};
    EXPECT_FALSE(evaluate(original, changed, tolerance).passes()) << "there is no texture";
}

TEST(Relations, WhatIsNoNumberIsBroken) {
    const Frame original = twoWalls();
    for (const Equality equality : {Equality::bits, Equality::sums, Equality::rounding}) {
        Frame changed = original;
        changed.channels[Channel::lit].at(2, 3, 0) = std::numeric_limits<float>::quiet_NaN();
        EXPECT_FALSE(evaluate(original, changed, toleranceFor(equality)).passes()) << nameOf(equality);
    }
    // A share of infinite light is infinite and must not allow anything.
    Frame endless = original;
    endless.channels[Channel::lit].at(2, 3, 0) = std::numeric_limits<float>::infinity();
    for (const Equality equality : {Equality::bits, Equality::sums, Equality::rounding})
        EXPECT_FALSE(evaluate(endless, original, toleranceFor(equality)).passes()) << nameOf(equality);
}

TEST(Relations, ImagesAreMappedBack) {
    Frame changed = twoWalls();
    changed.channels[Channel::lit].at(5, 2, 0) = 8;
    changed.channels[Channel::normals].at(5, 2, 0) = 1;
    changed.channels[Channel::normals].at(5, 2, 2) = 0;
    PixelMap map;
    map.border = 1;
    map.mirrored = true;
    map.light = 4;
    map.length = 2;
    map.turn = glm::dmat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0});  // +X becomes -Z
    map.ids = {1, 0};
    const Frame back = mappedBack(changed, map);
    EXPECT_EQ(back.settings.size, (Size{relatedWidth - 2, relatedHeight - 2}));
    const int x = relatedWidth - 2 - 1 - (5 - 1), y = 1;
    EXPECT_EQ(back.channels.at(Channel::lit).at(x, y, 0), 2);
    EXPECT_EQ(back.channels.at(Channel::depth).at(x, y), 1);
    EXPECT_EQ(back.channels.at(Channel::material_id).at(x, y), 1);
    EXPECT_EQ(back.channels.at(Channel::normals).at(x, y, 2), 1) << "+X of the changed one was +Z";
    EXPECT_EQ(back.channels.at(Channel::normals).at(x, y, 0), 0);
}

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
    EXPECT_NE(lacks("through_gltf", related("motion")), "");
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

TEST(Relations, GeometryIsTheSameWrittenOtherwise) {
    const Subject subject = related("gallery");
    const std::size_t triangles = triangleCount(flattened(subject.original)->scene);
    for (const char* name : {"draws_reversed", "meshes_split", "unindexed", "materials_permuted"})
        EXPECT_EQ(triangleCount(flattened(changedBy(name, subject).changed)->scene), triangles) << name;
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
    try {
        relationsOf(std::array{std::string("mirored")});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what())
                      .find("--relation mirored: there is no such relation; did you mean mirrored?"),
                  std::string::npos)
            << error.what();
    }
    EXPECT_EQ(relationsOf({}).size(), relations().size());
}

}  // namespace diptych::audit
