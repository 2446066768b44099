// The command `demo`: a first look at what dmpc does.
#pragma once

#include <iosfwd>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"

namespace dmpc::apps {

struct DemoOptions {
  bool quiet = false;  ///< no progress and no closing lines
};

void add_options(OptionSet options, DemoOptions& demo);

/// Renders a teapot on eight nodes of a modelled machine, and serves its page as `render --serve --report` does. Says which line
/// does so. The files lie in a folder that is removed at the end. Returns and throws as render_command() does.
int demo_command(const DemoOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
