// SPDX-License-Identifier: MIT
#include "shared/vulkan/instance/driver_files.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

namespace diptych {

std::optional<std::string> driverFilesFault() {
    for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
        const char* value = std::getenv(name);
        if (!value || !*value) continue;
        std::istringstream files(value);
        std::error_code ignored;
        for (std::string file; std::getline(files, file, ':');)
            if (!file.empty() && !std::filesystem::exists(file, ignored))
                return fmt::format("{} names {}, which does not exist; unset or correct it", name, file);
        return fmt::format(
            "{} is set to {}, which provides no device; unset it to use every installed driver", name, value);
    }
    return {};
}

void avoidCacheOnFullDisk() {
    constexpr std::uintmax_t min = 4 << 20;
    std::filesystem::path folder;
    // Same search order as Mesa (disk_cache_os.c).
    for (const auto& [variable, below] :
         {std::pair{"MESA_SHADER_CACHE_DIR", ""}, {"XDG_CACHE_HOME", ""}, {"HOME", ".cache"}})
        if (const char* const value = std::getenv(variable); folder.empty() && value && *value)
            folder = std::filesystem::path(value) / below;
    std::error_code failed;
    while (folder.has_relative_path() && !std::filesystem::exists(folder, failed))
        folder = folder.parent_path();
    const std::filesystem::space_info room = std::filesystem::space(folder, failed);
    if (!failed && room.available < min) ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

}  // namespace diptych
