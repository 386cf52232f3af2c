// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace diptych {

// The Content-Security-Policy of a page whose one inline script is `script`, as an element of its head: that
// script runs, and scripts that it adds itself; none that stands in the text of the page, which may come from
// the report of a shard. Nothing but pictures is loaded.
std::string pagePolicy(std::string_view script);

// The name of an inline script in a policy: 'sha256-...'.
std::string scriptSource(std::string_view script);

// True where a script beside a page is data: one call of a function of the page with JSON.
bool isDataScript(std::string_view script);

}  // namespace diptych
