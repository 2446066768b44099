// The command `view`: a scene in a browser, looked at from wherever the mouse turns the camera.
#pragma once

#include <iosfwd>

#include "apps/edge/system/interrupt.h"
#include "apps/view/options.h"

namespace dmpc::apps {

/// Reads and builds once, says on stderr where the page is, and renders what those who look on ask for, until a signal comes:
/// then it throws Interrupted. Throws as render_command() does for the scene, the options and memory, and core::InputError if the
/// port cannot be had.
int view_command(const ViewOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
