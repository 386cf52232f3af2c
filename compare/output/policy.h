// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace diptych {

// The Content-Security-Policy, as an element of the page's head. It allows the one inline script `script`
// and scripts that it adds. Other scripts in the text are blocked, because the text may come from another
// shard's report. Only images are loaded.
std::string pagePolicy(std::string_view script);

// The source expression of an inline script in a policy: 'sha256-...'.
std::string scriptSource(std::string_view script);

// True if a script beside a page is data: one call of a function of the page with JSON.
bool isDataScript(std::string_view script);

}  // namespace diptych
