// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/temporary.h"
#include "shared/text/open_folder.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace diptych {

// Atomically replaces the contents of a folder: writes to a temporary folder and puts it in place when
// complete. This holds however the program ends and for concurrent writers. Without put() nothing remains.
// Throws std::runtime_error naming the folder or file and a remedy.
class OutputFolder {
public:
    // Creates the temporary folder inside `folder`, or beside it if `folder` does not exist.
    explicit OutputFolder(const std::filesystem::path& folder);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return temporary_->path(); }  // write here
    std::filesystem::path operator/(const std::string& file) const { return path() / file; }
    void makeFolders(const std::vector<std::string>& files) const;  // parent folders of `files`

    // Puts `files` ("lit.png", "1/lit.png") in place. Removes files of `earlier` that they do not replace;
    // other files stay. `earlier` runs under the lock and throws if the files must not be replaced. A
    // folder with no other contents is exchanged as a whole; a shell inside it then has a removed working
    // directory. Files move one by one if an exchange is impossible: foreign files, a mount, a link,
    // another owner, our working directory. After a kill the next program finishes the moves.
    void put(const std::vector<std::string>& files, const std::function<std::vector<std::string>()>& earlier);

private:
    bool isThere();
    bool exchange(const std::vector<std::string>& earlier);

    std::filesystem::path folder_;
    OpenFolder beside_, destination_;  // its parent; the folder itself, once it exists
    std::unique_ptr<Temporary> temporary_;
};

// Links the finished file `name` below `root` to `to`, or copies it on a file system without hard links.
// Follows no link below `root`. Throws std::runtime_error naming the file.
void linkOrCopy(const std::filesystem::path& root, const std::string& name, const std::filesystem::path& to);

// The same, but always copies: for files whose owner may change them later.
void copyBelow(const std::filesystem::path& root, const std::string& name, const std::filesystem::path& to);

// Finishes moves of a program that was killed in put().
void finishOutput(const std::filesystem::path& folder);

}  // namespace diptych
