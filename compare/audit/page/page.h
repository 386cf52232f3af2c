// SPDX-License-Identifier: MIT
// Style and script in this folder, embedded at build time into the page of an audit.
#pragma once

namespace diptych::audit {

extern const char* const auditStyle;
extern const char* const auditScript;

}  // namespace diptych::audit
