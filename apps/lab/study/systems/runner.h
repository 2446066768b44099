// Runs systems on structures of the study's scene, each with the prices of its structure.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/lab/study/runs.h"
#include "apps/lab/study/studies.h"
#include "apps/lab/study/systems/setup.h"
#include "apps/lab/study/systems/too_small.h"
#include "apps/lab/study/systems/verdict.h"
#include "apps/scene/subject.h"

namespace dmpc::apps {

/// The figures of a finished run.
struct MeasuredRun {
  double seconds = 0;
  std::uint64_t film_hash = 0;
  std::size_t memory_bytes = 0;  ///< planned, of the node that needs most
  std::optional<std::uint32_t> in_flight, ray_batch;
  RunShares shares;
  std::vector<Cell> figures;  ///< by figure_columns()
};
std::vector<Column> figure_columns();

/// A run, or why there is none.
struct TimedSetup {
  std::optional<MeasuredRun> run;
  std::string misfit;
};

/// Not thread-safe. What it is made from outlives it.
class SystemRunner {
 public:
  SystemRunner(const SystemsStudy& study, StudyRuns& runs, Table& table) : study_(study), runs_(runs), table_(table) {}

  const SystemsStudy& study() const { return study_; }
  const core::Database& database(const StructureAsked& asked) { return *rendered(asked).database; }
  PictureSize picture() const;

  /// Runs all side by side. Throws Interrupted after a signal.
  std::vector<TimedSetup> time(const std::vector<SystemSetup>& setups);
  /// The seconds of draws 0 to study().draws - 1: by draw and setup.
  std::vector<std::vector<double>> time_draws(const std::vector<SystemSetup>& setups);

  /// Adds a row; `ahead`: the draws in which it is the fastest.
  void add_row(const char* table, const std::string& memory, const SystemSetup& setup, const TimedSetup& timed,
               std::optional<std::uint32_t> ahead);
  /// `search`: by which its options were found.
  ComparedRow compared(const SystemSetup& setup, const MeasuredRun& run, const std::string& search) const;
  void note(std::string sentence) { table_.add_note(std::move(sentence)); }

 private:
  /// The study's own, or one that is built on first use; without options.
  StudyRun rendered(const StructureAsked& asked);
  StudyRun study_run(const SystemSetup& setup, std::optional<std::uint32_t> draw);

  const SystemsStudy& study_;
  StudyRuns& runs_;
  Table& table_;
  std::map<StructureAsked, Subject> subjects_;
};

/// Adds the rows and verdicts of the table "described", and of "equal".
void describe(SystemRunner& runner);
void compare_at_equal_memory(SystemRunner& runner);

}  // namespace dmpc::apps
