// SPDX-License-Identifier: MIT
// .gltf and .glb alike, told apart as a reader does: by their first bytes. No file beside it can be named.
#include "shared/scene/gltf.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/sound_scene.h"

#include <tbb/global_control.h>

using namespace diptych;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // One thread: an input does the same whenever it runs.
    static const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    fuzz::readOrSayWhy([&] { fuzz::requireSound(parseGltf({data, data + size}, "fuzz.gltf")); });
    return 0;
}
