// SPDX-License-Identifier: MIT
// Two image files, read within the memory that is there and brought into one form.
#pragma once

#include "compare/verdict/image_diff_options.h"
#include "shared/image/free_memory.h"
#include "shared/image/image_file.h"

#include <string>
#include <vector>

namespace diptych {

struct ImagePair {
    ImageFile reference, test;  // equally sized; sRGB and straight alpha are decoded if the other is
    Claim compared;             // reserves memory for comparing, the decoded images apart
    std::vector<std::string> notes, failures;  // "a.png is PNG; it was decoded from sRGB to linear ..."
};

// Throws std::runtime_error before decoding if this process has too little memory; if a file cannot be read;
// if the sizes differ.
ImagePair readPair(const std::string& reference, const std::string& test, const ImageDiffOptions& options);

}  // namespace diptych
