// SPDX-License-Identifier: MIT
// A number in GBUFFER_WORDS is the only statement of a field's bits: shaders built from another number store
// the field within the bound of its new bits, and every other field as before, wherever it moves.
#include "compare/verdict/encoding_use.h"
#include "shared/contract/features.h"
#include "shared/contract/gbuffer.h"
#include "shared/contract/material.h"
#include "tests/probe/probe.h"
#include "tests/support/shader_sources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace diptych {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t rowWidth = 3 * 77 + 1, rowCount = 4096;  // stored.comp

// A channel that packed G-buffers store, and its field in GBUFFER_WORDS.
struct Stored {
    const DebugMode* mode;
    std::string standard, compact;
    std::size_t column() const { return 3 * static_cast<std::size_t>(channelIndex(mode->channel)); }
};
std::vector<Stored> storedChannels() {
    std::vector<Stored> all;
    const auto add = [&](Channel channel, std::string standard, std::string compact) {
        if (debugMode(channel).stored.code == FieldCode::exact) return;
        for (std::string* name : {&standard, &compact}) name->resize(name->size() - std::size("_BITS") + 1);
        all.push_back({&debugMode(channel), standard, compact});
    };
#define ADD(number, name, width, errorKind, kind, domain, supported_by, shows, stage, step, code, standard, \
            compact, part, texels, related)                                                                 \
    add(Channel::name, #standard, #compact);
    DEBUG_MODES(ADD)
#undef ADD
    return all;
}

std::vector<float> inputs() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> fraction(0.001f, 1), exponent(-2, 6), index(1.1f, 2.5f),
        length(100, 900);
    std::normal_distribution<float> normal;
    std::vector<float> in(rowWidth * rowCount);
    for (std::size_t row = 0; row < rowCount; ++row) {
        float* const values = &in[row * rowWidth];
        for (const Stored& stored : storedChannels()) {
            float* const at = values + stored.column();
            const float scale = std::exp2(exponent(random));
            for (int c = 0; c < stored.mode->width; ++c) switch (stored.mode->stored.code) {
                    case FieldCode::octahedral:
                    case FieldCode::line:
                        at[c] = normal(random);
                        break;
                    case FieldCode::radiance:
                        at[c] = scale * (fraction(random) + 0.1f);
                        break;
                    case FieldCode::index:
                        at[c] = index(random);
                        break;
                    case FieldCode::half:
                        at[c] = length(random);
                        break;
                    default:
                        at[c] = fraction(random);
                }
            if (stored.mode->stored.code == FieldCode::line) {  // perpendicular to the normal
                const float* n = values + 3 * static_cast<std::size_t>(channelIndex(Channel::normals));
                const float along = at[0] * n[0] + at[1] * n[1] + at[2] * n[2];
                for (int c = 0; c < 3; ++c) at[c] -= along * n[c];
            }
            if (isAngle(stored.mode->error_kind)) {
                const float size = std::hypot(at[0], at[1], at[2]);
                for (int c = 0; c < 3; ++c) at[c] /= size;
            }
        }
        values[rowWidth - 1] = static_cast<float>(row % 500);
    }
    return in;
}

// GBUFFER_WORDS of a header. `lowered`: takes a bit from every second field of each word, from the first (0)
// or the second (1) on.
struct Table {
    std::map<std::string, unsigned> bits;
    std::set<std::string> lowered;  // fields
};
Table tableOf(const fs::path& header, int lowered = -1) {
    const std::string text = contentsOf(header);
    const std::size_t begin = text.find("#define GBUFFER_WORDS"), end = text.find("\n\n", begin);
    std::istringstream lines(text.substr(begin, end - begin));
    std::string changed;
    Table table;
    const std::regex field("([A-Z][A-Z0-9_]+), ([0-9]+)");
    for (std::string line; std::getline(lines, line); changed += line + "\n") {
        int slot = 0;
        std::string copy = line;
        for (std::sregex_iterator i(copy.begin(), copy.end(), field), none; i != none; ++i, ++slot) {
            unsigned bits = static_cast<unsigned>(std::stoul((*i)[2]));
            if (slot % 2 == lowered && bits > 1) {
                table.lowered.insert((*i)[1]);
                line.replace(line.find((*i)[0]), (*i)[0].length(),
                             fmt::format("{}, {}", (*i)[1].str(), --bits));
            }
            table.bits[(*i)[1]] = bits;
        }
    }
    if (lowered >= 0)
        std::ofstream(header, std::ios::binary) << text.substr(0, begin) + changed + text.substr(end);
    return table;
}

std::vector<float> decoded(const fs::path& root, gpu::uint encoding, const std::vector<float>& in) {
    compileShader(root, "tests/probe/shaders/stored.comp", root / "stored.comp.spv");
    optimiseShader(root / "stored.comp.spv");
    return Probes().run((root / "stored").string(), in, rowWidth, rowWidth,
                        {{gpu::FEATURE_gbuffer_encoding, encoding},
                         {gpu::FEATURE_emission, 1},
                         {gpu::FEATURE_lightmap, 1},
                         {gpu::FEATURE_dielectric_specular, 1},
                         {gpu::FEATURE_captured, 1},
                         {gpu::FEATURE_gbuffer_layers, ~0u},
                         {gpu::FEATURE_layers, ~0u}});
}

class GBufferWords : public testing::TestWithParam<gpu::uint> {
protected:
    // A copy of the sources, in which tableOf() has lowered bits.
    fs::path copied(const std::string& name, int lowered = -1) {
        fs::remove_all(testFolder() / name);
        copyShaderSources(testFolder() / name);
        table_ = tableOf(testFolder() / name / "shared/contract/gbuffer.h", lowered);
        return testFolder() / name;
    }

    // Fields that shaders from `root` store beyond the bound of their bits in table_, or unlike before though
    // it does not lower them, or as before though it does.
    std::set<std::string> wrong(const fs::path& root) {
        const bool compact = GetParam() == gpu::GBUFFER_compact;
        const std::string normal = compact ? "COMPACT_NORMAL" : "STANDARD_NORMAL";
        const std::vector<float> now = decoded(root, GetParam(), in_);
        std::set<std::string> found;
        for (const Stored& stored : storedChannels()) {
            const std::string& name = compact ? stored.compact : stored.standard;
            const StoredField field{stored.mode->stored.code, table_.bits.at(name), table_.bits.at(normal)};
            bool same = true;
            for (std::size_t i = stored.column(); i < in_.size(); i += rowWidth) {
                if (!(storedUse(field, &now[i], &in_[i], stored.mode->width).fraction <= 1))
                    found.insert(name);
                same = same && std::equal(&now[i], &now[i] + 3, &before_[i]);
            }
            // A direction of anisotropy also turns with the normal.
            const bool turned = field.code == FieldCode::line && table_.lowered.contains(normal);
            if (same == (turned || table_.lowered.contains(name))) found.insert(name);
        }
        for (std::size_t i = rowWidth - 1; i < in_.size(); i += rowWidth)
            if (now[i] != in_[i]) found.insert("ID");
        return found;
    }

    using Fields = std::set<std::string>;
    Table table_;
    const std::vector<float> in_ = inputs(), before_ = decoded(copied("original"), GetParam(), in_);
};

TEST_P(GBufferWords, AnotherNumberChangesItsFieldAlone) {
    EXPECT_EQ(table_.bits.size(), 30u);
    for (const int lowered : {0, 1}) {
        const fs::path root = copied(fmt::format("lowered {}", lowered), lowered);
        EXPECT_GE(table_.lowered.size(), 11u);
        EXPECT_EQ(wrong(root), Fields()) << lowered;
    }
}

TEST_P(GBufferWords, ALiteralIsFound) {
    const fs::path root = copied("literal", 0), surface = root / "shaders/lib/surface";
    replaceIn(surface / "gbuffer.glsl", "params >> STANDARD_ID_SHIFT", "params >> 20u");
    replaceIn(surface / "gbuffer.glsl", "params >> COMPACT_ID_SHIFT", "params >> 22u");
    replaceIn(surface / "packing.glsl", "mask = EMISSION_STEPS - 1u", "mask = 511u");
    EXPECT_EQ(wrong(root), (Fields{"EMISSION_MANTISSA", "ID"}));
}

INSTANTIATE_TEST_SUITE_P(Encodings, GBufferWords,
                         testing::Values(gpu::GBUFFER_compact, gpu::GBUFFER_standard), [](const auto& each) {
                             return each.param == gpu::GBUFFER_compact ? "compact" : "standard";
                         });

}  // namespace
}  // namespace diptych
