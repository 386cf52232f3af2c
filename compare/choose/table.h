// SPDX-License-Identifier: MIT
// The candidates that a choice measures first: each path as given, and with each default single change.
#pragma once

#include "shared/frame/settings.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace diptych::choose {

// One Setting of a path: option and value as words of Settings::set().
struct Change {
    Path path = Path::deferred;
    std::string option, value;
    auto operator<=>(const Change&) const = default;
};

// Options and values; "*" is any. Most relevant first: the table drops the last ones if it is full.
#define DIPTYCH_DEFAULT_CHANGES(X)                                                                     \
    X("assign", "every,tiled,clustered")      /* light lists cost time and save it with many lights */ \
    X("gbuffer", "compact,standard,full")     /* bytes per pixel or normal error */                    \
    X("size", "*")                            /* fewer pixels: less time, more error */                \
    X("shadows", "off,pcf,evsm,msm4,clipmap") /* directional shadow filters */                         \
    X("prepass", "on,off")                    /* saves time with overdraw */                           \
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

// Each path's first candidate and those that differ from it in one default change; all candidates if they
// are few. `candidates`: each path's first comes before its others.
std::vector<Settings> tableOf(std::span<const Settings> candidates);

// Options in which `to` differs from `from`, with the values of `to`.
std::vector<Change> changesBetween(const Settings& from, const Settings& to);

}  // namespace diptych::choose
