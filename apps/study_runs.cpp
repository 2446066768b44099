#include "apps/study_runs.h"

#include <memory>
#include <utility>

#include "apps/progress.h"
#include "apps/side_by_side.h"
#include "core/expect.h"

namespace dmpc::apps {

StudyRuns::StudyRuns(const core::Database& database, const core::RenderSettings& settings, const StudyProgress& progress,
                     const Interrupt& interrupt)
    : database_(database), settings_(settings), progress_(progress), interrupt_(interrupt) {}

/// Of the next ones: "3 of 8", "3 to 8 of 8".
std::string StudyRuns::numbers(std::size_t run_count) const {
  const std::string last = run_count == 1 ? "" : " to " + std::to_string(count_ + run_count);
  const std::string all = progress_.run_count == 0 ? "" : " of " + std::to_string(progress_.run_count);
  return std::to_string(count_ + 1) + last + all;
}

template <class Options, class Render>
auto StudyRuns::run_shown(const std::string& computer, Options options, const Render& render) {
  interrupt_.check();
  Progress progress(progress_.output, progress_.is_shown, "run " + numbers(1) + ", " + computer + ": ");
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

void StudyRuns::run_side_by_side(std::span<const svm::RunOptions> runs,
                                 const std::function<void(std::size_t, const svm::Report&)>& take) {
  Progress progress(progress_.output, progress_.is_shown, "runs " + numbers(runs.size()) + ", side by side: ");
  const std::uint64_t pixel_count = settings_.camera.pixel_count();
  side_by_side(runs.size(), [&](std::size_t index) -> std::function<void()> {
    core::expect(runs[index].machine.has_value(), "runs side by side have no threads");
    check();
    const auto report = std::make_shared<const svm::Report>(svm::run_svm(database_, settings_, runs[index], interrupt_.token()));
    check();
    core::expect(report->end == nodes::RunEnd::finished, "a run that nobody stopped is finished");
    return [&, index, report] {
      compare(report->film);
      ++count_;
      take(index, *report);
      progress.update((index + 1) * pixel_count, runs.size() * pixel_count);
    };
  });
}

void StudyRuns::compare(const core::Film& film) {
  const std::uint64_t hash = film.hash();
  core::expect(hash == film_hash_.value_or(hash), "every run of a study gives the same film");
  film_hash_ = hash;
}

}  // namespace dmpc::apps
