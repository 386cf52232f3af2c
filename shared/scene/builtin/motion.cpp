// SPDX-License-Identifier: MIT
// The test scene of animation: joints, morph targets, nodes and lights, over the first two seconds.
#include "shared/scene/builtin/scenes.h"
#include "shared/scene/builtin/textures.h"
#include "shared/scene/model/tangents.h"
#include "shared/scene/motion/animation.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace diptych::builtin {
namespace {

// x, y, z, w of a rotation.
std::vector<float> rotation(double degrees, const glm::dvec3& axis) {
    const glm::dquat q = glm::angleAxis(glm::radians(degrees), glm::normalize(axis));
    return {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z),
            static_cast<float>(q.w)};
}
std::vector<float> negated(std::vector<float> values) {
    for (float& value : values) value = -value;
    return values;
}

class Stage : public Builder {
public:
    // Adds a node that animations move.
    int addMover(const std::string& name, const Transform& transform, int parent = -1) {
        const int node = addNode(name, -1, matrixOf(transform), parent);
        scene.nodes.back().transform = static_cast<int>(scene.transforms.size());
        scene.transforms.push_back(transform);
        return node;
    }

    // Adds a chain of joints along +Y, `step` metres apart, the first under `root`, and a skin with them
    // in that order. The bind pose ignores the root's transform.
    int addChain(const std::string& name, int count, double step, int root) {
        Skin skin{.name = name, .joints = {}, .joint_from_mesh = {}, .skeleton = root};
        for (int j = 0; j < count; ++j) {
            const Transform place{.translation = {0, j == 0 ? 0 : step, 0}};
            skin.joints.push_back(
                addMover(name + " " + std::to_string(j), place, j == 0 ? root : skin.joints.back()));
            skin.joint_from_mesh.emplace_back(at(0, -step * j, 0));
        }
        scene.skins.push_back(std::move(skin));
        return static_cast<int>(scene.skins.size()) - 1;
    }
    int joint(int skin, std::size_t j) const { return scene.skins[static_cast<std::size_t>(skin)].joints[j]; }

    int addSkinned(const std::string& name, Primitive shape, int material, int skin, int parent = -1) {
        const int node = addNode(name, addMesh(std::move(shape), material, name), glm::dmat4(1), parent);
        scene.nodes.back().skin = skin;
        return node;
    }
    int addMorphed(const std::string& name, Primitive shape, int material, const glm::dvec3& position) {
        const std::size_t targets = shape.targets.size();
        const int node = add(name, std::move(shape), material, position);
        scene.meshes.back().weights.assign(targets, 0.0f);
        return node;
    }

    // Adds a channel; `keys` has one entry per time, or three for a cubic spline.
    void animate(int animation, int node, AnimatedPart part, Interpolation interpolation,
                 std::vector<float> times, std::initializer_list<std::vector<float>> keys) {
        Keyframes frames{interpolation, std::move(times), {}, keys.begin()->size()};
        for (const std::vector<float>& key : keys)
            frames.values.insert(frames.values.end(), key.begin(), key.end());
        Animation& of = scene.animations[static_cast<std::size_t>(animation)];
        of.channels.push_back({node, static_cast<int>(of.keyframes.size()), part});
        of.keyframes.push_back(std::move(frames));
    }
};

// Assigns every vertex the joints with the largest weight(joint, position), as many as `sets` joint sets
// can store.
Primitive bound(Primitive shape, int joints, std::size_t sets,
                const std::function<double(int, const glm::dvec3&)>& weight) {
    shape.joint_sets.resize(sets);
    for (JointSet& set : shape.joint_sets) {
        set.joints.assign(shape.positions.size(), glm::u16vec4(0));
        set.weights.assign(shape.positions.size(), glm::vec4(0));
    }
    for (std::size_t v = 0; v < shape.positions.size(); ++v) {
        std::vector<std::pair<double, int>> of;
        for (int j = 0; j < joints; ++j) of.emplace_back(weight(j, glm::dvec3(shape.positions[v])), j);
        std::sort(of.rbegin(), of.rend());
        of.resize(std::min(of.size(), 4 * sets));
        double sum = 0;
        for (const auto& [w, j] : of) sum += w;
        for (std::size_t i = 0; i < of.size(); ++i) {
            if (!(of[i].first > 0)) continue;
            JointSet& set = shape.joint_sets[i / 4];
            set.joints[v][static_cast<int>(i % 4)] = static_cast<std::uint16_t>(of[i].second);
            set.weights[v][static_cast<int>(i % 4)] = static_cast<float>(of[i].first / sum);
        }
    }
    return shape;
}

// A column of that radius and height that stands on y = 0, with a flat top.
Primitive column(double radius, double height, int rings) {
    std::vector<glm::dvec2> profile;
    for (int r = 0; r <= rings; ++r) profile.emplace_back(radius, height * r / rings);
    profile.emplace_back(0.0, height);
    return lathe(profile, 16);
}

// Smooth step from 0 below `height` to 1 above it, `width` metres wide.
double above(double y, double height, double width) {
    const double t = std::clamp((y - height) / width + 0.5, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}
double upperOfTwo(int joint, const glm::dvec3& p) {
    const double upper = above(p.y, 0.7, 0.5);
    return joint == 1 ? upper : 1 - upper;
}

// The first target makes an ellipsoid with exact normals; the second shifts the texture and tints the
// upper half.
Primitive morphingBall(const TextureSlot& map) {
    Primitive ball =
        paint(sphere(0.45, 24, 12), [](const glm::vec3&) { return glm::vec4(0.9f, 0.8f, 0.7f, 1); });
    const glm::vec3 stretch(1.4f, 0.6f, 1);
    MorphTarget squash, dye;
    for (std::size_t v = 0; v < ball.positions.size(); ++v) {
        const glm::vec3 &p = ball.positions[v], &n = ball.normals[v];
        squash.positions.push_back(p * (stretch - 1.0f));
        squash.normals.push_back(glm::normalize(n / stretch) - n);
        dye.texcoords[0].emplace_back(0.5f * ball.texcoords[0][v].y, 0.0f);
        const float up = std::max(p.y, 0.0f);
        dye.colors.emplace_back(-2 * up, -up, 2 * up, 0.0f);  // beyond 0 to 1 at the top
    }
    ball.targets = {squash, dye};
    makeTangents(ball, map);
    ball.tangents_made = true;
    return ball;
}

Primitive morphingFacets() {
    Primitive facets = sphere(0.4, 8, 6);
    facets.texcoords[0].clear();
    MorphTarget twist;
    for (const glm::vec3& p : facets.positions) {
        const double angle = 2.5 * double{p.y}, c = std::cos(angle), s = std::sin(angle);
        twist.positions.push_back(glm::vec3(c * p.x + s * p.z, 1.5 * p.y, c * p.z - s * p.x) - p);
    }
    facets.targets = {twist};
    makeFlatNormals(facets);
    makeAnyTangents(facets);
    facets.flat = true;
    return facets;
}

// A leaf that bends forward into a parabola.
Primitive bendingLeaf() {
    Primitive leaf = quad({-0.4, 0, 0}, {0.8, 0, 0}, {0, 1, 0}, 3, 8);
    MorphTarget bend;
    for (const glm::vec3& p : leaf.positions) {
        bend.positions.emplace_back(0.0f, -0.3f * p.y * p.y, 0.6f * p.y * p.y);
        const glm::vec3 along(0, 1 - 0.6f * p.y, 1.2f * p.y);
        bend.normals.push_back(glm::normalize(glm::cross(glm::vec3(1, 0, 0), along)) - glm::vec3(0, 0, 1));
    }
    leaf.targets = {bend};
    return leaf;
}

// Animations of the scene, and what they use.
constexpr int metrics = 0, surroundings = 1;
constexpr AnimatedPart T = AnimatedPart::translation, R = AnimatedPart::rotation, S = AnimatedPart::scale,
                       W = AnimatedPart::weights;
constexpr Interpolation step = Interpolation::step, linear = Interpolation::linear,
                        cubic = Interpolation::cubic_spline;
constexpr glm::dvec3 X(1, 0, 0), Y(0, 1, 0), Z(0, 0, 1);

void addTentacle(Stage& b) {
    const int skin = b.material("tentacle", {{0.3f, 0.55f, 0.4f}, 0, 0.35f});
    const int tentacle = b.addChain("tentacle", 8, 0.2, b.addNode("tentacle root", -1, at(-2.1, 0, 0)));
    b.addSkinned("tentacle",
                 bound(column(0.16, 1.6, 16), 8, 2,
                       [](int j, const glm::dvec3& p) {
                           const double away = (p.y - 0.2 * j - 0.1) / 0.25;
                           return std::exp(-away * away) + 1e-3;
                       }),
                 skin, tentacle);
    for (std::size_t j = 1; j < 8; ++j)
        b.animate(
            metrics, b.joint(tentacle, j), R, cubic, {0, 2},
            {{0, 0, 0, 0}, rotation(0, Z), {0, 0, 0.5f, 0}, {0.5f, 0, 0, 0}, rotation(22, X), {0, 0, 0, 0}});
}

// Returns the box, to which the flag's mesh belongs.
int addFlag(Stage& b) {
    const int cloth = b.material("flag", {{0.8f, 0.15f, 0.1f}, 0, 0.7f});
    b.last().base_color.a = 0.6f;
    b.last().alpha_mode = AlphaMode::blend;
    b.last().double_sided = true;
    const int pole = b.addNode("pole", -1, at(2.5, 1, 0) * rotated(-90, Z));  // its +Y points to the right
    const int flag = b.addChain("flag", 3, 0.45, pole);
    const int box = b.addMover("box", {.translation = {-2.6, 0.3, 1.7}});
    b.scene.nodes.back().mesh =
        b.addMesh(diptych::box({0.5, 0.5, 0.5}, 0.05), b.material("box", {glm::vec3(0.8f), 0, 0.3f}), "box");
    b.addSkinned("flag",
                 bound(quad({0.4, 0, 0}, {0, 1.35, 0}, {-0.8, 0, 0}, 9, 4), 3, 1,
                       [](int j, const glm::dvec3& p) {
                           return std::max(1 - std::abs(p.y / 0.45 - j), j == 2 && p.y > 0.9 ? 1.0 : 0.0);
                       }),
                 cloth, flag, box);
    for (std::size_t j = 0; j < 3; ++j)
        b.animate(
            metrics, b.joint(flag, j), R, linear, {0, 0.5f, 1, 1.5f, 2},
            {rotation(j == 1 ? 40 : -30, X), rotation(j == 1 ? -25 : 20, X), rotation(j == 1 ? -40 : 30, X),
             rotation(j == 1 ? 25 : -20, X), rotation(j == 1 ? 40 : -30, X)});
    return box;
}

// The sliding box, and a light that circles above.
void addSurroundings(Stage& b, int box) {
    b.animate(surroundings, box, T, cubic, {0, 2},
              {{0, 0, 0}, {-2.6f, 0.3f, 1.7f}, {1, 1, 0}, {1, -1, 0}, {0.2f, 0.3f, 1.7f}, {0, 0, 0}});
    b.animate(surroundings, box, R, linear, {0, 2}, {rotation(0, Y), rotation(130, Y)});
    const int orbit = b.addMover("orbit", {.translation = {0, 2.3, 0.6}});
    b.animate(surroundings, orbit, R, linear, {0, 0.5f, 1, 1.5f, 2},
              {rotation(0, Y), rotation(90, Y), rotation(180, Y), rotation(270, Y), rotation(360, Y)});
    const int lamp = b.addNode("lamp", -1, at(2.2, 0, 0), orbit);
    b.point({0, 0, 0}, {1, 0.75f, 0.45f}, 9, 8);
    b.scene.lights.back().node = lamp;
    b.scene.lights.back().shadow = true;
}

}  // namespace

// From left to right: a column of two bones that bends while its upper half stretches 4:1; a tentacle with
// eight joints; a ball with morphed shape, UV and colour under a normal map; a normal-mapped column under
// a mirrored root; twisting facets; and a translucent flag. In front: a bending leaf, and a sliding box
// that casts a shadow. The flag's mesh is a child of the box in the node tree, which must not move it. A
// light circles above.
void motion(Builder& builder) {
    Stage b;
    b.camera("front", {0, 2.6, 8.2}, {0, 0.85, 0}, 34, 0.1, 100);
    b.scene.animations = {{"figures", {}, {}}, {"surroundings", {}, {}}};
    const TextureSlot weave = b.texture(normalMap("weave", weaveHeights(64), 8), 3);

    const int ground = b.material("floor", {glm::vec3(0.55f), 0, 0.7f});
    b.add("floor", quad({-4.5, 0, 2.6}, {9, 0, 0}, {0, 0, -4.4}), ground);

    const int clay = b.material("clay", {{0.75f, 0.4f, 0.25f}, 0, 0.5f});
    const int bones = b.addChain("bone", 2, 0.7, b.addNode("column root", -1, at(-3.3, 0, 0)));
    b.addSkinned("column", bound(column(0.25, 1.4, 12), 2, 1, upperOfTwo), clay, bones);
    b.animate(metrics, b.joint(bones, 1), R, linear, {0, 1, 2},
              {rotation(0, Z), negated(rotation(-60, Z)), rotation(40, X)});
    b.animate(metrics, b.joint(bones, 1), S, linear, {0, 0.75f, 2}, {{1, 1, 1}, {0.5f, 2, 0.5f}, {1, 1, 1}});
    addTentacle(b);

    const int porcelain = b.material("ball", {glm::vec3(1), 0, 0.4f});
    b.last().normal_texture = weave;
    const int ball = b.addMorphed("ball", morphingBall(weave), porcelain, {-0.8, 0.6, 0});
    b.animate(metrics, ball, W, cubic, {0, 1, 2},
              {{0, 0}, {0, 0}, {2, 1}, {0, 0}, {1, 0.5f}, {0, 1}, {0, 0}, {0.25f, 1}, {0, 0}});

    const int bark = b.material("mirrored column", {{0.5f, 0.45f, 0.6f}, 0, 0.45f});
    b.last().normal_texture = weave;
    const int mirror = b.addNode("mirrored root", -1, at(0.5, 0, 0) * scaled(-1, 1, 1));
    const int mirrored = b.addChain("mirrored bone", 2, 0.7, mirror);
    b.addSkinned("mirrored column", bound(column(0.25, 1.4, 12), 2, 1, upperOfTwo), bark, mirrored);
    b.animate(metrics, b.joint(mirrored, 1), R, linear, {0, 1, 2},
              {rotation(0, Z), rotation(-60, Z), rotation(40, X)});

    const int stone = b.material("facets", {{0.3f, 0.45f, 0.7f}, 0.2f, 0.4f});
    const int facets = b.addMorphed("facets", morphingFacets(), stone, {1.6, 0.7, 0});
    b.animate(metrics, facets, W, step, {0, 0.5f, 1.25f}, {{0}, {1}, {-0.5f}});
    const int box = addFlag(b);

    const int green = b.material("leaf", {glm::vec3(1), 0, 0.6f});
    b.last().base_color_texture = b.texture(leaf("leaf", 64));
    b.last().alpha_mode = AlphaMode::mask;
    b.last().double_sided = true;
    const int bending = b.addMorphed("leaf", bendingLeaf(), green, {1.1, 0, 1.3});
    b.animate(metrics, bending, W, linear, {0, 1, 2}, {{0}, {1.2f}, {-0.6f}});
    addSurroundings(b, box);
    b.sun({-0.5, -1.2, -0.8}, {0.9f, 0.95f, 1}, 2.5f);
    builder.scene = std::move(b.scene);
}

}  // namespace diptych::builtin
