#include "apps/render/onlookers.h"

#include <algorithm>
#include <utility>

namespace dmpc::apps {

namespace {

/// References of one node, however many there are.
constexpr std::size_t references_least = 1024;

}  // namespace

double MissEstimate::misses(std::uint32_t cache_pages) const {
  return static_cast<double>(curve.misses(cache_pages / every)) * every;
}

Onlookers::Onlookers(const RenderOptions& options, std::uint32_t page_count, std::size_t references_max) {
  const std::uint32_t node_count = options.computer.node_count;
  std::vector<nodes::Observer*> members;
  if (options.trace.path) {
    recorder_ = std::make_unique<nodes::TraceRecorder>(node_count + 1, trace_choice(options.trace, node_count));
    members.push_back(recorder_.get());
  }
  if (options.report) {
    profile_ = std::make_unique<nodes::ActivityProfile>(node_count + 1);
    members.push_back(profile_.get());
  }
  if (options.report && options.strategy == Strategy::svm) {
    fetches_ = std::make_unique<svm::FetchWatch>(node_count, page_count, svm::fetch_sample_max, options.pages.homes);
    members.push_back(fetches_.get());
  }
  keeps_references_ = options.references.has_value();
  if (keeps_references_) {
    reference_logs_.resize(node_count);
  } else if (options.report && options.strategy == Strategy::svm && !counts_pages(options)) {
    reference_logs_.assign(node_count, svm::ReferenceLog(std::max(references_least, references_max / node_count)));
  }
  if (members.size() == 1) {
    observer_ = members.front();
  } else if (!members.empty()) {
    observer_ = &group_.emplace(std::move(members));
  }
}

Sights Onlookers::take() {
  Sights sights;
  if (recorder_) {
    sights.trace = recorder_->take();
  }
  if (profile_) {
    sights.view.emplace().steps = profile_->take();
  }
  if (fetches_) {
    sights.view->fetches = fetches_->take();
  }
  if (sights.view && !reference_logs_.empty()) {
    sights.view->misses = estimate_misses();
  }
  if (keeps_references_) {
    sights.references = std::move(reference_logs_);
  }
  return sights;
}

/// Of all nodes together, from the same share of each node's references.
MissEstimate Onlookers::estimate_misses() {
  MissEstimate estimate;
  for (const svm::ReferenceLog& log : reference_logs_) {
    estimate.every = std::max(estimate.every, log.every());
  }
  for (svm::ReferenceLog& log : reference_logs_) {
    log.thin_out(estimate.every);
    estimate.curve += svm::MissCurve(log.pages());
  }
  return estimate;
}

}  // namespace dmpc::apps
