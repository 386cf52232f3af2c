// SPDX-License-Identifier: MIT
#include "compare/files/folder_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace diptych {

FolderLock::FolderLock(const std::filesystem::path& folder) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::seconds patience{30};
    constexpr std::chrono::milliseconds pause{5};
    file_ = ::open(folder.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    // The parent folder may be writable but not readable.
    if (file_ < 0) file_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file_ < 0) return;
    const Clock::time_point end = Clock::now() + patience;
    while (::flock(file_, LOCK_EX | LOCK_NB) != 0 && (errno == EWOULDBLOCK || errno == EINTR)) {
        if (Clock::now() > end) {
            ::close(file_);
            throw std::runtime_error(
                fmt::format("{}: another program has been writing there for {} s; wait for it, or choose "
                            "another folder with -o",
                            folder.string(), patience.count()));
        }
        std::this_thread::sleep_for(pause);
    }
}

FolderLock::~FolderLock() {
    if (file_ >= 0) ::close(file_);
}

}  // namespace diptych
