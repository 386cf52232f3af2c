// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace diptych {

// The target if `out` is a link, else `out`. A link that the user names is kept; links inside a folder are
// replaced (AtomicFile). Throws std::runtime_error naming -o if links lead in a circle, or if another user
// but root made the link.
std::filesystem::path linkedFile(const std::filesystem::path& out);

}  // namespace diptych
