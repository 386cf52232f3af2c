// SPDX-License-Identifier: MIT
// Two image files as diff compares them: read within the memory that is there, and in one form.
#pragma once

#include "compare/verdict/image_diff.h"
#include "shared/image/free_memory.h"
#include "shared/image/image_file.h"

namespace diptych {

struct ImagePair {
    ImageFile reference, test;
    bool same_bytes = false;
    Claim compared;  // of what comparing needs beside the decoded images
};

// Throws before decoding if this process has too little memory.
ImagePair readPair(const std::string& reference, const std::string& test, const ImageDiffOptions& options);

// Makes both linear and associated if one is; adds notes and failures to `diff`. `same_bytes`: the files are
// equal, read or not. Throws std::runtime_error if the sizes differ.
void bringTogether(ImageFile& a, ImageFile& b, bool same_bytes, bool strict, ImageDiff& diff);

}  // namespace diptych
