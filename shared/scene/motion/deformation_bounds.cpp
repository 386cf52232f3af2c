// SPDX-License-Identifier: MIT
#include "shared/scene/motion/deformation_bounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace diptych {

namespace {

// ---- clusters ----------------------------------------------------------------------------------------

void include(VertexBox& box, const glm::vec3& p) {
    box.min = glm::min(box.min, p);
    box.max = glm::max(box.max, p);
}

struct Fraction {
    std::uint32_t joint;
    double fraction;
};
// The joints of a vertex, each once, with normalized weights as in posed.cpp.
void fractionsOf(const Primitive& primitive, std::size_t vertex, std::vector<Fraction>& fractions) {
    fractions.clear();
    double whole = 0;
    for (const JointSet& set : primitive.joint_sets)
        for (int i = 0; i < 4; ++i) {
            const double weight = set.weights[vertex][i];
            if (!(weight > 0)) continue;
            whole += weight;
            const std::uint32_t joint = set.joints[vertex][i];
            const auto known = std::ranges::find(fractions, joint, &Fraction::joint);
            if (known == fractions.end())
                fractions.push_back({joint, weight});
            else
                known->fraction += weight;
        }
    for (Fraction& fraction : fractions) fraction.fraction /= whole;
}

class Clustering {
public:
    explicit Clustering(const Primitive& primitive)
        : primitive_(primitive),
          min_size_(std::clamp<std::size_t>(primitive.positions.size() / 64, 1, 8)),
          order_(primitive.positions.size()) {
        for (std::uint32_t t = 0; t < primitive.targets.size(); ++t)
            if (!primitive.targets[t].positions.empty()) result_.targets.push_back(t);
        std::vector<std::uint32_t> joint(order_.size(), 0);
        for (std::uint32_t v = 0; v < order_.size(); ++v) {
            order_[v] = v;
            fractionsOf(primitive, v, fractions_);
            double max = 0;
            for (const Fraction& fraction : fractions_)
                if (fraction.fraction > max) joint[v] = fraction.joint, max = fraction.fraction;
        }
        std::ranges::stable_sort(order_, {}, [&](std::uint32_t v) { return joint[v]; });
        std::vector<std::span<std::uint32_t>> runs;
        // Vertices of joints with too few vertices for a cluster of their own.
        std::vector<std::uint32_t> few;
        for (std::size_t begin = 0, end; begin < order_.size(); begin = end) {
            for (end = begin; end < order_.size() && joint[order_[end]] == joint[order_[begin]];) ++end;
            const std::span run = std::span(order_).subspan(begin, end - begin);
            if (run.size() < min_size_)
                few.insert(few.end(), run.begin(), run.end());
            else
                runs.push_back(run);
        }
        // About 512 clusters in total, but at least 4 per joint.
        int splits = 8;
        while (splits > 2 && (runs.size() << splits) > 512) --splits;
        for (const std::span<std::uint32_t> run : runs) divide(run, splits);
        divide(few, 64);
    }

    DeformationBounds take() { return std::move(result_); }

private:
    const Primitive& primitive_;
    const std::size_t min_size_;
    std::vector<std::uint32_t> order_;
    std::vector<Fraction> fractions_;  // of the current vertex
    DeformationBounds result_;

    // Splits the vertices at the median along their box's longest side, up to `splits` times and down to
    // the least cluster size.
    void divide(std::span<std::uint32_t> vertices, int splits) {
        if (vertices.empty()) return;
        VertexBox box;
        for (const std::uint32_t v : vertices) include(box, primitive_.positions[v]);
        if (splits == 0 || vertices.size() < 2 * min_size_) return add(vertices, box);
        const glm::vec3 size = box.max - box.min;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t half = vertices.size() / 2;
        std::ranges::nth_element(vertices, vertices.begin() + static_cast<std::ptrdiff_t>(half), {},
                                 [&](std::uint32_t v) { return primitive_.positions[v][axis]; });
        divide(vertices.first(half), splits - 1);
        divide(vertices.subspan(half), splits - 1);
    }

    void add(std::span<const std::uint32_t> vertices, const VertexBox& box) {
        struct Fractions {
            DeformationBounds::Influence influence;
            double sum = 0;
            std::size_t vertices = 0;
        };
        std::map<std::uint32_t, Fractions> joints;
        for (const std::uint32_t v : vertices) {
            fractionsOf(primitive_, v, fractions_);
            for (const Fraction& fraction : fractions_) {
                Fractions& joint = joints[fraction.joint];
                DeformationBounds::Influence& influence = joint.influence;
                influence.joint = fraction.joint;
                influence.min =
                    joint.vertices == 0 ? fraction.fraction : std::min(influence.min, fraction.fraction);
                influence.max = std::max(influence.max, fraction.fraction);
                include(influence.box, primitive_.positions[v]);
                joint.sum += fraction.fraction;
                ++joint.vertices;
            }
        }
        DeformationBounds::Cluster cluster{.box = box};
        double max = 0;
        for (auto& [j, joint] : joints) {
            if (joint.vertices < vertices.size()) joint.influence.min = 0;
            if (joint.sum > max) cluster.joint = j, max = joint.sum;
            result_.influences.push_back(joint.influence);
        }
        for (const std::uint32_t v : vertices) {
            fractionsOf(primitive_, v, fractions_);
            double others = 0;
            for (const Fraction& fraction : fractions_)
                if (fraction.joint != cluster.joint) others += fraction.fraction;
            cluster.others = std::max(cluster.others, others);
        }
        cluster.end_influence = static_cast<std::uint32_t>(result_.influences.size());
        result_.clusters.push_back(cluster);
        for (const std::uint32_t t : result_.targets) {
            VertexBox& deltas = result_.deltas.emplace_back();
            for (const std::uint32_t v : vertices) include(deltas, primitive_.targets[t].positions[v]);
        }
    }
};

// ---- a pose ------------------------------------------------------------------------------------------

struct Range {
    glm::dvec3 min, max;
};

Range transformed(const glm::dmat4& m, const Range& box) {
    const glm::dvec3 centre = (box.min + box.max) * 0.5, half = (box.max - box.min) * 0.5;
    const glm::dvec3 at(m * glm::dvec4(centre, 1));
    const glm::dvec3 reach = glm::abs(glm::dvec3(m[0])) * half.x + glm::abs(glm::dvec3(m[1])) * half.y +
                             glm::abs(glm::dvec3(m[2])) * half.z;
    return {at - reach, at + reach};
}

class ClusterBounds {
public:
    ClusterBounds(const DeformationBounds& bounds, const Deformation& deformation)
        : bounds_(bounds), deformation_(deformation) {}

    Range of(std::size_t cluster) {
        const DeformationBounds::Cluster& c = bounds_.clusters[cluster];
        const Range moves = morph(cluster);
        const auto morphed = [&](const VertexBox& box) {
            return Range{glm::dvec3(box.min) + moves.min, glm::dvec3(box.max) + moves.max};
        };
        if (!deformation_.world_from_mesh) return transformed(deformation_.world_from_object, morphed(c.box));
        const std::uint32_t begin = cluster == 0 ? 0 : bounds_.clusters[cluster - 1].end_influence;
        const std::span influences = std::span(bounds_.influences).subspan(begin, c.end_influence - begin);
        const glm::dmat4& frame = joint(c.joint);
        if (influences.size() == 1) return transformed(frame, morphed(c.box));

        Range hull{glm::dvec3(std::numeric_limits<double>::infinity()),
                   glm::dvec3(-std::numeric_limits<double>::infinity())};
        Range around = transformed(frame, morphed(c.box));
        terms_.clear();
        double rest = c.others;
        for (const DeformationBounds::Influence& influence : influences) {
            const Range box = morphed(influence.box), own = transformed(joint(influence.joint), box);
            hull = {glm::min(hull.min, own.min), glm::max(hull.max, own.max)};
            if (influence.joint == c.joint) continue;
            const Range apart = transformed(joint(influence.joint) - frame, box);
            around.min += influence.min * apart.min;
            around.max += influence.min * apart.max;
            rest -= influence.min;
            terms_.push_back({apart, influence.max - influence.min});
        }
        // The weight beyond the minima goes to the joints that pull furthest.
        for (int axis = 0; axis < 3; ++axis) {
            around.max[axis] += furthest(rest, [&](const Term& t) { return t.apart.max[axis]; });
            around.min[axis] -= furthest(rest, [&](const Term& t) { return -t.apart.min[axis]; });
        }
        return {glm::max(hull.min, around.min), glm::min(hull.max, around.max)};
    }

private:
    struct Term {
        Range apart;
        double fraction;
    };
    const DeformationBounds& bounds_;
    const Deformation& deformation_;
    std::vector<Term> terms_;
    std::vector<std::array<double, 2>> pulls_;

    const glm::dmat4& joint(std::uint32_t j) const { return (*deformation_.world_from_mesh)[j]; }

    // Range of the morph offset of the cluster's vertices.
    Range morph(std::size_t cluster) const {
        Range sum{glm::dvec3(0), glm::dvec3(0)};
        if (!deformation_.weights) return sum;
        for (std::size_t i = 0; i < bounds_.targets.size(); ++i) {
            const double weight = (*deformation_.weights)[bounds_.targets[i]];
            if (weight == 0) continue;
            const VertexBox& deltas = bounds_.deltas[cluster * bounds_.targets.size() + i];
            const glm::dvec3 a = weight * glm::dvec3(deltas.min), b = weight * glm::dvec3(deltas.max);
            sum.min += glm::min(a, b);
            sum.max += glm::max(a, b);
        }
        return sum;
    }

    // Largest sum of fraction * pull(term), with each fraction at most the term's and their total at most
    // `rest`.
    template <class Pull>
    double furthest(double rest, const Pull& pull) {
        pulls_.clear();
        for (const Term& term : terms_)
            if (pull(term) > 0) pulls_.push_back({pull(term), term.fraction});
        std::ranges::sort(pulls_, std::greater{});
        double sum = 0;
        for (const auto& [far, fraction] : pulls_) {
            const double taken = std::min(fraction, rest);
            if (!(taken > 0)) break;
            sum += taken * far;
            rest -= taken;
        }
        return sum;
    }
};

}  // namespace

DeformationBounds deformationBounds(const Primitive& primitive) {
    DeformationBounds bounds = Clustering(primitive).take();
    bounds.main_joint = mainJoint(primitive);
    return bounds;
}

std::uint32_t mainJoint(const Primitive& primitive) {
    std::vector<double> fractions(1, 0);
    for (const JointSet& set : primitive.joint_sets)
        for (std::size_t v = 0; v < set.joints.size(); ++v)
            for (int i = 0; i < 4; ++i) {
                const std::size_t joint = set.joints[v][i];
                if (joint >= fractions.size()) fractions.resize(joint + 1, 0);
                fractions[joint] += set.weights[v][i];
            }
    return static_cast<std::uint32_t>(std::ranges::max_element(fractions) - fractions.begin());
}

void prepareDeformationBounds(Scene& scene) {
    for (Mesh& mesh : scene.meshes)
        for (Primitive& primitive : mesh.primitives)
            if (!primitive.joint_sets.empty() || !primitive.targets.empty() ||
                !primitive.tangent_groups.empty())
                primitive.deformation_bounds = deformationBounds(primitive);
}

WorldBox boundsOf(const DeformationBounds& bounds, const Deformation& deformation) {
    ClusterBounds of(bounds, deformation);
    glm::dvec3 min(maxCoordinate), max(-maxCoordinate);
    for (std::size_t c = 0; c < bounds.clusters.size(); ++c) {
        const Range range = of.of(c);
        for (int axis = 0; axis < 3; ++axis) {
            // A non-finite matrix gives NaN, which becomes the full range.
            min[axis] =
                range.min[axis] >= -maxCoordinate ? std::min(min[axis], range.min[axis]) : -maxCoordinate;
            max[axis] =
                range.max[axis] <= maxCoordinate ? std::max(max[axis], range.max[axis]) : maxCoordinate;
        }
    }
    if (!(min.x <= max.x && min.y <= max.y && min.z <= max.z)) return {};  // nothing is within range
    // Posing and this function also round in double: relative errors of 1e-16, a few dozen times.
    const double farthest = std::max(glm::length(min), glm::length(max));
    const glm::dvec3 slack(1e-5 * glm::length(max - min) + 1e-13 * farthest);
    return {glm::max(min - slack, -maxCoordinate), glm::min(max + slack, maxCoordinate)};
}

}  // namespace diptych
