// SPDX-License-Identifier: MIT
#include "compare/files/linked_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace diptych {

namespace fs = std::filesystem;

fs::path linkedFile(const fs::path& out) {
    const auto fail = [&](const std::string& why) {
        throw std::runtime_error(fmt::format("-o {}: {}", out.string(), why));
    };
    struct stat link {};
    std::error_code error(::lstat(out.c_str(), &link) == 0 ? 0 : errno, std::generic_category());
    fs::path target = out;
    if (!error && S_ISLNK(link.st_mode)) {
        // Another user may have put it there during the run.
        if (link.st_uid != ::geteuid() && link.st_uid != 0)
            fail("is another user's link, which may lead anywhere; name its target");
        target = fs::weakly_canonical(out, error);
        if (error && error != std::errc::too_many_symbolic_link_levels) fail(error.message());
    }
    if (error == std::errc::too_many_symbolic_link_levels)
        fail("its links lead in a circle; give another name");
    return target;
}

}  // namespace diptych
