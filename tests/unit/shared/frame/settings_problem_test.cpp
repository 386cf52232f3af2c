// SPDX-License-Identifier: MIT
// Valid and invalid combinations of Settings.
#include "shared/frame/settings.h"

#include <gtest/gtest.h>

namespace diptych {
namespace {

constexpr const char* tilesNeedDepthsSays =
    "--assign tiled cannot be used with --prepass off: it needs the depths of a tile; use --prepass on";

// A tile's lights depend on its depths: deferred has a G-buffer, forward+ needs a pre-pass. Froxels and
// objects need no depths.
TEST(SettingsProblem, OnlyForwardPlussTilesNeedAPrePass) {
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference})
        for (const Assignment assign : {Assignment::every, Assignment::tiled, Assignment::clustered})
            for (const Switch prepass : {Switch::automatic, Switch::on, Switch::off}) {
                Settings s;
                s.path = path;
                s.assign = assign;
                s.prepass = prepass;
                const bool wrong =
                    path == Path::forward_plus && assign == Assignment::tiled && prepass == Switch::off;
                EXPECT_EQ(s.problem().value_or("none"), wrong ? tilesNeedDepthsSays : "none")
                    << nameOf(path) << " " << nameOf(assign) << " " << nameOf(prepass);
            }
}

TEST(SettingsProblem, OnlyDeferredKnowsNoObjects) {
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference})
        for (const Switch prepass : {Switch::automatic, Switch::on, Switch::off}) {
            Settings s;
            s.path = path;
            s.assign = Assignment::per_object;
            s.prepass = prepass;
            EXPECT_EQ(s.problem().has_value(), path == Path::deferred) << nameOf(path);
        }
}

TEST(SettingsProblem, OnlyTheReferenceFollowsLightBetweenMicrofacets) {
    for (const Path path : {Path::deferred, Path::forward_plus, Path::reference})
        for (const auto& [multiscatter, name] : enumNames<Multiscatter>()) {
            Settings s;
            s.path = path;
            s.multiscatter = multiscatter;
            EXPECT_EQ(s.problem().has_value(), path != Path::reference && multiscatter == Multiscatter::walk)
                << nameOf(path) << " " << name;
        }
}

TEST(SettingsProblem, OnlyTheReferenceInModeSceneHasSamples) {
    for (const ReferenceMode mode : {ReferenceMode::surface, ReferenceMode::scene})
        for (const int spp : {1, 2, 65536}) {
            Settings s;
            s.path = Path::reference;
            s.reference_mode = mode;
            s.spp = spp;
            EXPECT_EQ(s.problem().has_value(), mode == ReferenceMode::surface && spp != 1) << spp;
        }
}

}  // namespace
}  // namespace diptych
