// SPDX-License-Identifier: MIT
#include "shared/vulkan/instance/driver_probe.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace diptych {

namespace fs = std::filesystem;

EnvironmentVariables::EnvironmentVariables(const std::vector<std::pair<std::string, std::string>>& values) {
    for (const auto& [name, value] : values) {
        const char* const there = std::getenv(name.c_str());
        before_.emplace_back(name, there ? std::optional<std::string>(there) : std::nullopt);
        ::setenv(name.c_str(), value.c_str(), 1);
    }
}

EnvironmentVariables::~EnvironmentVariables() {
    for (const auto& [name, value] : before_) {
        if (value)
            ::setenv(name.c_str(), value->c_str(), 1);
        else
            ::unsetenv(name.c_str());
    }
}

QuietStandardError::QuietStandardError() : before_(::dup(STDERR_FILENO)) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    ::dup2(nowhere, STDERR_FILENO);
    ::close(nowhere);
}

QuietStandardError::~QuietStandardError() {
    if (before_ < 0) return;
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
}

DriverProbe probeInChild(const std::function<std::string()>& act) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "testing a driver: pipe");
    const pid_t child = ::fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "testing a driver: fork");
    if (child == 0) {
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        const QuietStandardError quiet;
        std::string output;
        try {
            output = act();
        } catch (const std::exception& failed) {
            output = failed.what();
        }
        const ssize_t written = ::write(ends[1], output.data(), output.size());
        ::_exit(written < 0 ? 1 : 0);
    }
    ::close(ends[1]);
    DriverProbe probe_result;
    std::array<char, 4096> part{};
    for (ssize_t count = 0; (count = ::read(ends[0], part.data(), part.size())) != 0;) {
        if (count < 0 && errno != EINTR) break;
        if (count > 0) probe_result.output.append(part.data(), static_cast<std::size_t>(count));
    }
    ::close(ends[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    probe_result.crashed = !WIFEXITED(status) || WEXITSTATUS(status) != 0;
    return probe_result;
}

std::vector<std::string> radvFiles() {
    std::vector<std::string> files;
    const auto isRadv = [](const fs::path& file) {
        return file.filename().string().starts_with("radeon_icd") && file.extension() == ".json";
    };
    if (const char* const named = std::getenv("VK_DRIVER_FILES")) {
        std::istringstream all(named);
        for (std::string file; std::getline(all, file, ':');)
            if (isRadv(file)) files.push_back(file);
    }
    for (const char* const folder :
         {"/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/share/vulkan/icd.d"}) {
        if (!files.empty()) break;
        std::error_code missing;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
            if (isRadv(entry.path())) files.push_back(entry.path().string());
    }
    std::ranges::sort(files);
    return files;
}

}  // namespace diptych
