// SPDX-License-Identifier: MIT
#include "shared/vulkan/driver_files.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace diptych {

std::optional<std::string> driverFilesFault() {
    for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        const char* value = std::getenv(name);
        if (!value || !*value) continue;
        std::istringstream files(value);
        std::error_code ignored;
        for (std::string file; std::getline(files, file, ':');)
            if (!file.empty() && !std::filesystem::exists(file, ignored))
                return fmt::format("{} is set and names {}, which does not exist: unset it or mend it", name,
                                   file);
        return fmt::format("{} is set to {}, which brings no device: unset it to use every installed driver",
                           name, value);
    }
    return {};
}

}  // namespace diptych
