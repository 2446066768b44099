// The command `view`: a scene in a browser, looked at from wherever the mouse turns the camera.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/run/strategy_options.h"
#include "apps/run/systems.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct ViewOptions : StrategyOptions {
  std::optional<System> system;  ///< whose options the strategy has, if one was named
  PictureOptions picture;
  DatabaseOptions database;
  std::uint16_t port = 0;  ///< 0: any that is free
  bool quiet = false;      ///< no progress, and nothing said of the scene
};

/// Declares them, and which go together. Whatever decides of a picture means what it means to `render`; what would have the scene
/// change with the camera is refused.
void add_options(OptionSet options, ViewOptions& view);

/// Reads and builds once, says on stderr where the page is, and renders what those who look on ask for, until they want a picture
/// rendered: then this process becomes dmpc render. At a signal it throws Interrupted. Throws as render_command() does for the
/// scene, the options and memory, and core::InputError if the port cannot be had.
int view_command(const ViewOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
