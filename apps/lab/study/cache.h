// The study `cache`: how often nodes miss pages with caches of any size and policy, and the cost on a machine.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table_options.h"
#include "apps/lab/study/cache_curves.h"
#include "apps/scene/database_options.h"
#include "apps/scene/picture_options.h"
#include "core/database/database.h"
#include "core/picture/film/film.h"
#include "core/picture/pixel_task.h"
#include "nodes/machine.h"
#include "svm/run.h"

namespace dmpc::apps {

/// The runs of the study: one scene rendered by different computers, which must all give the same film.
struct CacheRuns {
  const core::Database& database;
  const core::RenderSettings& settings;
  const Interrupt& interrupt;
  bool shows_progress = false;  ///< on stderr
  std::uint32_t count = 0;
  std::optional<std::uint64_t> film_hash = {};  ///< of every run taken; nothing before the first

  /// Throws as the run does, Interrupted if a signal comes before its end. Thread-safe.
  svm::Report run(const svm::RunOptions& options) const;
  /// Counts a run. Throws core::InternalError unless its film is the first one's.
  void take(const core::Film& film);
};

/// For each cache size, the faults of the replacement policies and of the optimum, all for the same references; and, if there is
/// a machine, its time, efficiency and page traffic with lru.
struct CacheStudy {
  std::uint32_t node_count = 32;           ///< at least 2
  std::vector<std::uint32_t> cache_pages;  ///< sizes in pages; empty: about 12, from 1 to all pages of other nodes
  std::optional<nodes::Machine> machine;   ///< if not given, nothing is timed
  std::vector<std::string> policy_places;  ///< of policies other than dmpc's own
  std::vector<ForeignPolicy> policies;     ///< those policies, after load()

  /// Loads the policies. Throws as they do.
  void load(const std::function<void()>& check) { policies = load_policies(policy_places, check); }

  /// `machine_name` is set to the typed text if a machine was typed: the table must not replace its file.
  void add_options(OptionSet set, std::string& machine_name);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  /// Adds row after row to a table that has columns(), as the runs end. Throws as these do.
  void measure(CacheRuns& runs, Table& table) const;
  /// They explain the columns, and quote the 1994 article's result if the scene, as on the command line, is one of its own.
  std::vector<std::string> notes(const std::string& scene) const;
  /// A sentence computed from a table's rows, empty if there are too few.
  std::string conclusion(const Table& table) const;
};

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
