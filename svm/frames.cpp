#include "svm/frames.h"

#include <utility>

#include "core/base/expect.h"
#include "nodes/ranks/life_signs.h"
#include "nodes/ranks/repeated_runs.h"
#include "svm/ranks.h"
#include "svm/resident.h"

namespace dmpc::svm {
namespace {

/// Those that every node keeps for good.
std::vector<PageId> resident_pages(const core::Database& database, const core::RenderSettings& settings, const Plan& plan,
                                   nodes::RankLinks* ranks, const std::stop_token& stop) {
  const auto find = [&] { return most_used_pages(database, settings, plan.resident_count, stop); };
  return ranks == nullptr || plan.resident_count == 0 ? find() : nodes::with_life_signs(*ranks, find);
}

}  // namespace

Frames::Frames(const Strategy& strategy, const core::Database& database, const core::RenderSettings& first,
               const RunOptions& options, const std::stop_token& stop, bool are_several)
    : database_(database),
      options_(options),
      settings_(first),
      detail_(first.fine_detail(database)),
      plan_(plan_of(strategy, database, first, options)),
      bytes_(database.bytes()),
      recorded_(options.pages.record_references ? plan_.request.computer.node_count : 0) {
  plan_.request.detail = &detail_;
  plan_.request.database = database.bytes();
  nodes::RankLinks* const ranks = options.computer.ranks;
  plan_.resident = resident_pages(database, first, plan_, ranks, stop);
  if (ranks != nullptr) {
    hand_out(plan_, first, database, options.watching.elsewhere.order, are_several, *ranks);
  }
  std::vector<ReferenceLog>* const logs = recorded_.empty() ? options.pages.reference_logs : &recorded_;
  maker_ = strategy.maker(plan_, settings_, bytes_, options_.watching, logs);
}

Report Frames::render(const core::RenderSettings& settings, std::stop_token stop) {
  settings_ = settings;
  if (!computer_) {
    computer_.emplace(plan_, maker_, options_);
  } else {
    detail_ = settings.fine_detail(database_);
    computer_->begin_frame(settings_, &detail_);
    if (options_.computer.ranks != nullptr) {
      nodes::hand_out_again(settings_, *options_.computer.ranks);
    }
  }
  Report report = computer_->render(std::move(stop));
  for (std::size_t i = 0; i < recorded_.size(); ++i) {
    report.nodes[i].references = std::exchange(recorded_[i], {});
  }
  return report;
}

}  // namespace dmpc::svm
