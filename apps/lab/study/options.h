// The options of `study`: a scene, which study, and where its table goes.
#pragma once

#include <string>
#include <variant>

#include "apps/edge/line/command_line.h"
#include "apps/edge/table/table_options.h"
#include "apps/lab/study/balance.h"
#include "apps/lab/study/cache.h"
#include "apps/lab/study/frames.h"
#include "apps/lab/study/speedup.h"
#include "apps/lab/study/systems.h"
#include "apps/lab/study/traffic.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

/// One study: its file is all that there is of it. Each has a `name` (the word on the command line) and a `description`;
/// add_options() declares what is its own; columns() are its table's, plots() of such a
/// table; notes() say what the columns mean, and what the 1994 article found if the scene, as on the command line, is one of its
/// own; conclusion() is a sentence or two on a table, computed from its rows, empty if they tell too little. measure() adds row
/// after row to a table that has columns(), as the runs end, and throws as StudyRuns does.
using Study = std::variant<BalanceStudy, TrafficStudy, CacheStudy, SpeedupStudy, SystemsStudy, FramesStudy>;

struct StudyOptions {
  Study study;
  PictureOptions picture;
  DatabaseOptions database;
  TableOutput table;
  std::string machine_name;  ///< as given on the command line, if it was
  bool quiet = false;        ///< no progress
};

/// Declares those that all studies share, and those of the study that `options` holds now.
void add_options(OptionSet set, StudyOptions& options);

}  // namespace dmpc::apps
