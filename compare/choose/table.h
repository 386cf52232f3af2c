// SPDX-License-Identifier: MIT
// The candidates that a choice draws first: each path as given, and with each of the usual single changes.
#pragma once

#include "shared/frame/settings.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych::choose {

// One Setting of a path: its option and value, in the words of Settings::set().
struct Change {
    Path path = Path::deferred;
    std::string option, value;
    auto operator<=>(const Change&) const = default;
};

//  option, values: "*" is any. The first matter most: of more changes than a table has room for, they stay.
#define DIPTYCH_USUAL_CHANGES(X)                                                                       \
    X("assign", "every,tiled,clustered")      /* light lists cost time, and save it for many lights */ \
    X("gbuffer", "compact,standard,full")     /* bytes a pixel against the error of normals */         \
    X("size", "*")                            /* fewer pixels: less time, more error */                \
    X("shadows", "off,pcf,evsm,msm4,clipmap") /* filters of the sun's shadow */                        \
    X("prepass", "on,off")                    /* saves time where surfaces hide each other */          \
    X("transparency", "sorted,unsorted,weighted,moments")                                              \
    X("msaa", "1,4")                                                                                   \
    X("msaa-edges", "all,exact,similar,coverage")                                                      \
    X("ibl", "split,sampled")                                                                          \
    X("ibl-diffuse", "sh,map")                                                                         \
    X("shadow-size", "512,1024")                                                                       \
    X("shadow-lights", "0,1,4")                                                                        \
    X("area-lights", "ltc,representative")                                                             \
    X("light-cutoff", "0,0.01")                                                                        \
    X("specular-albedo", "table,fit")                                                                  \
    X("skinning", "compute,vertex")                                                                    \
    X("lit-format", "fp16")                                                                            \
    X("lighting", "compute")

inline constexpr std::size_t mostInTable = 24;

// Candidates of a table: each path's first, and those that differ from it in one usual change; all where they
// are few. `candidates`: each path's first comes before its others.
std::vector<Settings> tableOf(std::span<const Settings> candidates);

// The options and values in which Settings differ from others of their path.
std::vector<Change> changesBetween(const Settings& from, const Settings& to);

}  // namespace diptych::choose
