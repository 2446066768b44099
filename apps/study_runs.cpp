#include "apps/study_runs.h"

#include <utility>

#include "apps/progress.h"
#include "core/expect.h"

namespace dmpc::apps {

StudyRuns::StudyRuns(const core::Database& database, const core::RenderSettings& settings, const StudyProgress& progress,
                     const Interrupt& interrupt)
    : database_(database), settings_(settings), progress_(progress), interrupt_(interrupt) {}

template <class Options, class Render>
auto StudyRuns::run_shown(const std::string& computer, Options options, const Render& render) {
  interrupt_.check();
  Progress progress(progress_.output, progress_.is_shown,
                    "run " + std::to_string(count_ + 1) + " of " + std::to_string(progress_.run_count) + ", " + computer + ": ");
  options.progress = [&progress](std::uint32_t done, std::uint32_t total) { progress.update(done, total); };
  auto report = render(database_, settings_, options, interrupt_.token());
  interrupt_.check();
  core::expect(report.end == nodes::RunEnd::finished, "a run that nobody stopped is finished");
  compare(report.film);
  ++count_;
  return report;
}

dataflow::Report StudyRuns::run(const std::string& computer, dataflow::RunOptions options) {
  return run_shown(computer, std::move(options), dataflow::run_dataflow);
}

svm::Report StudyRuns::run(const std::string& computer, svm::RunOptions options) {
  return run_shown(computer, std::move(options), svm::run_svm);
}

void StudyRuns::compare(const core::Film& film) {
  const std::uint64_t hash = film.hash();
  core::expect(hash == film_hash_.value_or(hash), "every run of a study gives the same film");
  film_hash_ = hash;
}

}  // namespace dmpc::apps
