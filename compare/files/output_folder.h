// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/temporary.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace diptych {

// A folder's new contents, written to a temporary folder and put in place when they are complete: at every
// moment the folder holds all of the old or all of the new contents, however the program ends and however
// many programs write to it. Without put() nothing is left behind. Throws std::runtime_error naming the
// folder or file and a remedy.
class OutputFolder {
public:
    // The temporary folder is made inside `folder`, or beside it if it does not exist yet.
    explicit OutputFolder(const std::filesystem::path& folder);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return temporary_->path(); }  // where to write
    std::filesystem::path operator/(const std::string& file) const { return path() / file; }
    void makeFolders(const std::vector<std::string>& files) const;  // those that `files` stand in

    // Puts `files` (names such as "lit.png" or "1/lit.png") in place and removes the files of `earlier` that
    // they do not replace; all other files stay. `earlier` is called while no other program can put files
    // there, and throws if they must not be replaced. A folder that holds nothing else is exchanged for the
    // new one as a whole; a shell whose working directory it was then stands in the removed folder. If an
    // exchange is impossible (files of others, a mount, a link, another owner, this program's own working
    // directory), files are moved one by one; if this program is killed meanwhile, the next one finishes the
    // moves.
    void put(const std::vector<std::string>& files, const std::function<std::vector<std::string>()>& earlier);

private:
    bool exchange(const std::vector<std::string>& earlier);

    std::filesystem::path folder_;
    std::unique_ptr<Temporary> temporary_;
};

// Gives the finished file `name` below `root` a second name, which shares its bytes where the file system has
// hard links, else copies it. No link below `root` is followed. Throws std::runtime_error naming the file.
void linkOrCopy(const std::filesystem::path& root, const std::string& name, const std::filesystem::path& to);

// The same with bytes of its own: of a file that is somebody else's, who may write to it later.
void copyBelow(const std::filesystem::path& root, const std::string& name, const std::filesystem::path& to);

// Finishes the moves of a program that was killed in put(), if there are any.
void finishOutput(const std::filesystem::path& folder);

}  // namespace diptych
