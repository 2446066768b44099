#include "apps/lab/study/runs.h"

#include <mutex>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/resource_exhaustion.h"
#include "apps/lab/crowd/side_by_side.h"
#include "apps/run/run_strategy.h"
#include "core/base/ranges.h"
#include "svm/page_options.h"

namespace dmpc::apps {
namespace {

/// The pixels of concurrent runs, on one line.
///
/// Thread safety: any thread; a lock is held only while the line is written.
class CommonProgress {
 public:
  CommonProgress(Progress& line, std::size_t run_count, std::uint64_t pixels_each)
      : line_(line), pixels_each_(pixels_each), done_of_run_(run_count, 0) {}

  void update(std::size_t run, std::uint64_t done) {
    const std::lock_guard lock(mutex_);
    if (done > done_of_run_[run]) {
      done_ += done - done_of_run_[run];
      done_of_run_[run] = done;
      line_.update(done_, pixels_each_ * done_of_run_.size());
    }
  }
  void finish(std::size_t run) { update(run, pixels_each_); }

 private:
  Progress& line_;
  std::uint64_t pixels_each_;
  std::mutex mutex_;
  std::vector<std::uint64_t> done_of_run_;
  std::uint64_t done_ = 0;
};

}  // namespace

StudyRuns::StudyRuns(const core::Database& database, const core::RenderSettings& settings, const StudyProgress& progress,
                     const Interrupt& interrupt)
    : database_(database), settings_(settings), alone_(settings), progress_(progress), interrupt_(interrupt) {
  alone_.skips.bundles = false;
}

/// Returns the numbers of the next runs: "3 of 8", "3 to 8".
std::string StudyRuns::numbers(std::size_t run_count) const {
  const std::string last = run_count == 1 ? "" : " to " + std::to_string(count_ + run_count);
  const std::string all = expected_ == 0 ? "" : " of " + std::to_string(expected_);
  return std::to_string(count_ + 1) + last + all;
}

template <class Options, class Render>
auto StudyRuns::run_shown(const std::string& computer, const core::RenderSettings& settings, Options options,
                          const Render& render) {
  interrupt_.check();
  Progress progress(progress_.output, progress_.is_shown, "run " + numbers(1) + ", " + computer + ": ");
  options.watching.progress = [&progress](std::uint32_t done, std::uint32_t total) { progress.update(done, total); };
  auto report = render(database_, settings, options, interrupt_.token());
  interrupt_.check();
  core::expect(report.end == nodes::RunEnd::finished, "a run that nobody stopped is finished");
  compare(report.film);
  ++count_;
  return report;
}

dataflow::Report StudyRuns::run(const std::string& computer, dataflow::RunOptions options) {
  return run_shown(computer, alone_, std::move(options), dataflow::run_dataflow);
}

svm::Report StudyRuns::run(const std::string& computer, svm::RunOptions options) {
  return run_shown(computer, settings_, std::move(options), svm::run_svm);
}

/// Returns nothing if a signal prevented the run from finishing. Throws what the run throws. Only a plan that cannot be made is a
/// misfit: later failures are errors.
std::optional<StudyOutcome> StudyRuns::outcome_of(const StrategyOptions& run,
                                                  const std::function<void(std::uint32_t, std::uint32_t)>& progress) const {
  StudyOutcome outcome;
  ReadyRun ready;
  try {
    ready = make_ready(run, database_, settings_, interrupt_.token());
  } catch (const ComputerCapacityError&) {
    throw;
  } catch (const core::InputError& error) {
    outcome.misfit = error.what();
  }
  if (ready.start) {
    outcome.notes = std::move(ready.notes);
    outcome.report = ready.start(progress, interrupt_.token());
  }
  const bool is_stopped = outcome.report ? account_of(*outcome.report).end == nodes::RunEnd::interrupted : interrupt_.requested();
  return is_stopped ? std::nullopt : std::optional(std::move(outcome));
}

void StudyRuns::run_side_by_side(std::span<const StrategyOptions> runs, const Take& take) {
  Progress line(progress_.output, progress_.is_shown, "runs " + numbers(runs.size()) + ", side by side: ");
  CommonProgress progress(line, runs.size(), settings_.camera.pixel_count());
  for (const StrategyOptions& run : runs) {
    core::expect(run.computer.machine.has_value(), "runs side by side have no threads");
    note_prices(*run.computer.machine, database_);
  }
  std::vector<std::string> misfits;
  const auto measure = [&](std::size_t index) {
    const auto update = [&progress, index](std::uint32_t done, std::uint32_t) { progress.update(index, done); };
    return interrupt_.requested() ? std::nullopt : outcome_of(runs[index], update);
  };
  measure_each(runs.size(), Turns::side_by_side, measure, [&](std::size_t index, const std::optional<StudyOutcome>& outcome) {
    if (!outcome) {
      return;
    }
    if (outcome->report) {
      compare(account_of(*outcome->report).film);
      ++count_;
    } else {
      misfits.push_back(outcome->misfit);
    }
    take(index, *outcome);
    progress.finish(index);
  });
  if (!runs.empty() && misfits.size() == runs.size()) {
    throw NothingFits(misfits.front());
  }
}

void StudyRuns::add_price_notes(Table& table) const {
  for (const std::string& note : price_notes_) {
    if (!note.empty()) {
      table.add_note(note + ".");
    }
  }
}

void add_notes(const std::string& who, const StudyOutcome& outcome, Table& table) {
  for (const std::string& note : outcome.notes) {
    table.add_note(who + ": " + note + ".");
  }
  if (!outcome.report) {
    table.add_note(who + ": the scene does not fit. " + outcome.misfit + ".");
  }
}

StrategyOptions on_usual_machine() {
  StrategyOptions options;
  choose_machine(options, find_machine_preset("ipsc2")->machine);
  return options;
}

std::string machine_text(const nodes::Machine& machine) {
  return "Machine " + name_with_links(machine) + " (machine_digest " + hash_text(machine.digest()) + ")";
}

std::string in_flight_text(Strategy strategy) {
  return counted(strategy == Strategy::replicated ? 1U : svm::modelled_in_flight, "pixel");
}

void StudyRuns::compare(const core::Film& film) { compare_hash(film.hash()); }

void StudyRuns::take(std::uint64_t film_hash) {
  compare_hash(film_hash);
  ++count_;
}

void StudyRuns::compare_hash(std::uint64_t hash) {
  core::expect(hash == film_hash_.value_or(hash), "every run of a study gives the same film");
  film_hash_ = hash;
}

}  // namespace dmpc::apps
