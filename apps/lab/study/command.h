// The command `study cache`: renders one scene, and prints a table of its caches.
#pragma once

#include <iosfwd>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table_options.h"
#include "apps/lab/study/cache.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

struct StudyOptions {
  CacheStudy study;
  PictureOptions picture;
  DatabaseOptions database;
  TableOutput table;
  std::string machine_name;  ///< as given on the command line
  bool quiet = false;        ///< no progress
};

void add_options(OptionSet set, StudyOptions& options);

/// Measures and writes as run_tabled() does. Throws core::InputError for a scene that cannot be read or outputs that cannot be
/// made, core::UsageError for an output that is the scene's file, core::InternalError if two runs give different films.
int study_command(const StudyOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
