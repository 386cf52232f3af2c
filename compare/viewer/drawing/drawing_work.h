// SPDX-License-Identifier: MIT
// The work of the drawing thread.
#pragma once

#include "compare/viewer/drawing/drawing_options.h"
#include "compare/viewer/drawing/mailbox.h"

namespace diptych::viewer {

// Draws what the mailbox requests, the most urgent first, until it says stop.
void runDrawing(const DrawingOptions& options, Mailbox& mailbox);

}  // namespace diptych::viewer
