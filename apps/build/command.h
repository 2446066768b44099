// The command `build`: writes a scene's database to a file, which stands for the scene from then on.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct BuildRequest {
  PictureOptions picture;
  DatabaseOptions database;
  std::filesystem::path output;
  bool for_any_camera = false;     ///< with the pad of an eye as far away as any
  std::vector<std::string> words;  ///< the options given, for whoever reads the file
  bool quiet = false;
};

void add_options(OptionSet options, BuildRequest& build);

/// Writes the file as a whole or not at all. A signal ends the process. Returns the exit status 0. Throws core::InputError and
/// core::UsageError for the scene as render_command() does, and if the file cannot be written.
int build_command(const BuildRequest& build, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
