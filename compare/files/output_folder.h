// SPDX-License-Identifier: MIT
#pragma once

#include "shared/image/temporary.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace diptych {

// A folder's new contents, made aside and put in place when they are whole: at every moment the folder holds
// all of the earlier or all of the new, however the program ends and however many programs write it. Without
// put() nothing of them stays. Throws std::runtime_error naming the folder or file and what helps.
class OutputFolder {
public:
    // A name without a file: the temporary folder stands beside it; otherwise in it, as its files will.
    explicit OutputFolder(const std::filesystem::path& folder);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    const std::filesystem::path& path() const { return temporary_->path(); }  // where to write
    std::filesystem::path operator/(const std::string& file) const { return path() / file; }

    // Puts `files` in place, names as "lit.png" or "1/lit.png", and removes those of `earlier` that they do
    // not replace; whatever else lies there stays. `earlier` is asked while no other program puts files
    // there, and throws where they may not be replaced. A folder that holds nothing else changes places with
    // the new one as a whole; whoever stands in it (a shell) then stands in the removed one. Where that
    // cannot be (files of others, a mount, a link, another owner, this program's own working directory) files
    // are moved one by one, by a plan that the next program carries out should this one be killed meanwhile.
    void put(const std::vector<std::string>& files, const std::function<std::vector<std::string>()>& earlier);

private:
    bool exchange(const std::vector<std::string>& earlier);

    std::filesystem::path folder_;
    std::unique_ptr<Temporary> temporary_;
};

// Carries out what a program that was killed in put() has left undone. Nothing where there is nothing of it.
void finishOutput(const std::filesystem::path& folder);

}  // namespace diptych
