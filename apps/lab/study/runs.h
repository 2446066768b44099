// The runs of a study: one scene rendered repeatedly by different computers, which must all give the same film.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table.h"
#include "apps/run/report.h"
#include "apps/run/strategy_options.h"
#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/picture/film/film.h"
#include "core/picture/pixel_task.h"
#include "dataflow/run.h"
#include "svm/run.h"

namespace dmpc::apps {

/// Where the progress of runs is shown.
struct StudyProgress {
  std::ostream& output;
  bool is_shown = false;
};

/// Result of a run on a modelled machine.
struct StudyOutcome {
  std::optional<Report> report;    ///< of a finished run
  std::string misfit;              ///< if there is no report: why the scene does not fit, with the memory and a remedy
  std::vector<std::string> notes;  ///< sentences on what had to be reduced to fit
};

/// Adds notes about `who`, such as "8 nodes": what was reduced to fit, or why the scene does not.
void add_notes(const std::string& who, const StudyOutcome& outcome, Table& table);

/// Returns the options with which studies that model a machine begin: the ipsc2, and defaults.
StrategyOptions on_usual_machine();
/// Returns "Machine ipsc2, ... (machine_digest 0123...)", for a note.
std::string machine_text(const nodes::Machine& machine);
/// Returns "1 pixel", or for forest "a quarter of a node's share, 16 to 256 pixels": what is in flight on a modelled machine by
/// default.
std::string in_flight_text(Strategy strategy);

/// The scene fits none of the computers that were to render it: the message is the first one's misfit.
struct NothingFits : core::CapacityError {
  using core::CapacityError::CapacityError;
};

/// Not thread-safe. What it is made from outlives it.
class StudyRuns {
 public:
  StudyRuns(const core::Database& database, const core::RenderSettings& settings, const StudyProgress& progress,
            const Interrupt& interrupt);

  /// Sets the total number of runs for the progress from now on.
  void expect_runs(std::size_t count) { expected_ = count; }
  /// Renders with strategy dataflow or svm and the given options, whose progress is replaced. `computer` names it in a few words
  /// for a waiting user. Travelling rays are traversed singly: the composition of bundles depends on the schedule, and the work
  /// depends on the bundles. Throws as the run does, Interrupted if a signal comes before its end, and core::InternalError if the
  /// film is not the first run's.
  dataflow::Report run(const std::string& computer, dataflow::RunOptions options);
  svm::Report run(const std::string& computer, svm::RunOptions options);

  /// Receives the outcome of runs[i]: one at a time, in the order of i, on any thread.
  using Take = std::function<void(std::size_t, const StudyOutcome&)>;
  /// Renders by any strategies on modelled machines, which have no threads, as many at a time as the real computer has cores.
  /// After a signal, the runs that it stopped or prevented are left out, and check() throws. Throws NothingFits after `take` has
  /// received a misfit for every run, if there are any; before that core::UsageError for options that their strategy does not
  /// take, core::InternalError if a film is not the first run's, and whatever else a run throws: `take` has then received all
  /// runs before that one, and none after it.
  void run_side_by_side(std::span<const StrategyOptions> runs, const Take& take);

  /// Takes down a note if the machine's prices are for other structures than the database's.
  void note_prices(const nodes::Machine& machine, const core::Database& database) {
    price_notes_.insert(price_note(machine, database.structure()));
  }
  /// Adds those notes, each once.
  void add_price_notes(Table& table) const;

  /// The scene that the study renders.
  const core::Database& database() const { return database_; }
  const core::RenderSettings& settings() const { return settings_; }

  /// Throws Interrupted if a signal has come. Thread-safe.
  void check() const { interrupt_.check(); }

  /// Throws core::InternalError unless `film` equals the first run's.
  void compare(const core::Film& film);
  /// Compares and counts a run carried out elsewhere, whose film has this hash.
  void take(std::uint64_t film_hash);

  std::uint32_t count() const { return count_; }
  /// Returns the hash of every run's film; nothing before the first.
  std::optional<std::uint64_t> film_hash() const { return film_hash_; }

 private:
  std::string numbers(std::size_t run_count) const;
  void compare_hash(std::uint64_t hash);
  template <class Options, class Render>
  auto run_shown(const std::string& computer, const core::RenderSettings& settings, Options options, const Render& render);
  std::optional<StudyOutcome> outcome_of(const StrategyOptions& run,
                                         const std::function<void(std::uint32_t, std::uint32_t)>& progress) const;

  const core::Database& database_;
  const core::RenderSettings& settings_;
  core::RenderSettings alone_;  ///< the same, for rays that are traversed singly
  StudyProgress progress_;
  const Interrupt& interrupt_;
  std::size_t expected_ = 0;  ///< 0: unknown
  std::uint32_t count_ = 0;
  std::optional<std::uint64_t> film_hash_;
  std::set<std::string> price_notes_;
};

}  // namespace dmpc::apps
