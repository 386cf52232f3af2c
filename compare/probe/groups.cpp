// SPDX-License-Identifier: MIT
#include "compare/probe/groups.h"

namespace diptych::probe {

const std::vector<Probe>& allProbes() {
    static const std::vector<Probe> probes = [] {
        std::vector<Probe> all;
        for (const auto group : {operationProbes, brdfProbes, lightProbes, codeProbes, positionProbes,
                                 momentProbes, ltcProbes, surfaceProbes, airProbes})
            for (Probe& probe : group()) all.push_back(std::move(probe));
        return all;
    }();
    return probes;
}

}  // namespace diptych::probe
