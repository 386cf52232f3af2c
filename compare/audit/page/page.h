// SPDX-License-Identifier: MIT
// The style and the script in this folder, which the page of an audit contains; embedded at build time.
#pragma once

namespace diptych::audit {

extern const char* const auditStyle;
extern const char* const auditScript;

}  // namespace diptych::audit
