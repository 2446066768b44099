// The options of `view`: a scene, a computer, and a strategy, as `render` has them.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/edge/line/command_line.h"
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

}  // namespace dmpc::apps
