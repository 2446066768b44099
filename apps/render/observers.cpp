#include "apps/render/observers.h"

#include <algorithm>
#include <utility>

#include "apps/frontend/run/work.h"
#include "core/base/expect.h"
#include "nodes/flat_bytes.h"

namespace dmpc::apps {

namespace {

// Limits of stored waits: of all nodes during a run, 9 MB, with a minimum per node; and at its end, for a page.
constexpr std::size_t waits_max = std::size_t{1} << 17U, waits_of_node_least = 64, waits_shown_max = 8192;

}  // namespace

Observers::Observers(const ObserverOrder& order, nodes::Observer* another) : order_(order) {
  std::vector<nodes::Observer*> members;
  if (another != nullptr) {
    members.push_back(another);
  }
  if (!order.heat_kinds.empty()) {
    heat_.emplace(order.pixel_count, order.heat_kinds);
  }
  if (heat_ && heat_->has(core::HeatKind::done)) {
    done_ = std::make_unique<nodes::DoneObserver>(order.node_count + 1, *heat_);
    members.push_back(done_.get());
  }
  if (order.trace) {
    recorder_ = std::make_unique<nodes::TraceRecorder>(order.node_count + 1, *order.trace);
    members.push_back(recorder_.get());
  }
  if (order.has_profile) {
    profile_ = std::make_unique<nodes::ActivityProfile>(order.node_count + 1, work_of, order.wait_of);
    members.push_back(profile_.get());
  }
  if (order.follows_paths) {
    waits_ =
        std::make_unique<nodes::WaitLog>(order.node_count + 1, std::max(waits_of_node_least, waits_max / (order.node_count + 1)));
    members.push_back(waits_.get());
  }
  if (order.exchange) {
    members.push_back(&exchange_.emplace(*order.exchange));
  }
  if (order.fetches) {
    fetches_ = std::make_unique<svm::FetchObserver>(order.node_count, order.page_count, svm::fetch_sample_max, *order.fetches);
    members.push_back(fetches_.get());
  }
  if (order.references_max) {
    reference_logs_.assign(order.node_count, svm::ReferenceLog(*order.references_max));
  }
  if (members.size() == 1) {
    observer_ = members.front();
  } else if (!members.empty()) {
    observer_ = &group_.emplace(std::move(members));
  }
}

nodes::Watching Observers::watching() {
  nodes::Watching watching{.heat = heat_ ? &*heat_ : nullptr, .observer = observer_};
  if (!order_.is_empty()) {
    watching.elsewhere = {.order = bytes_of(order_),
                          .add = [this](std::string_view seen, const nodes::ClockDrift& clock) { add(seen, clock); }};
  }
  return watching;
}

/// Visits the observers that are shared by ranks, except the logs.
template <class Self, class Visit>
void Observers::visit_shared(Self& self, const Visit& visit) {
  const auto visit_if_there = [&visit](auto&... each) { ((each ? visit(each) : void()), ...); };
  visit_if_there(self.heat_, self.recorder_, self.profile_, self.fetches_);
}

void Observers::begin_again() {
  core::expect(!recorder_ && !profile_ && !fetches_ && reference_logs_.empty(), "of several runs heat maps alone are made");
  if (heat_) {
    heat_->clear();
  }
}

std::string Observers::seen() const {
  nodes::FlatWriter flat;
  visit_shared(*this, [&flat](const auto& one) { flat.put_bytes(one->bytes()); });
  svm::put_logs(flat, reference_logs_);
  return flat.take();
}

void Observers::add(std::string_view seen, const nodes::ClockDrift& clock) {
  nodes::FlatReader flat(seen);
  visit_shared(*this, [&](auto& one) {
    if constexpr (requires { one->add(seen, clock); }) {
      one->add(flat.take_bytes(), clock);
    } else {
      one->add(flat.take_bytes());
    }
  });
  svm::take_logs(flat, reference_logs_);
  core::expect(flat.is_at_end(), "all that was seen was asked for");
}

RunProfile Observers::take() {
  RunProfile run_profile;
  if (recorder_) {
    run_profile.trace = recorder_->take();
  }
  if (profile_) {
    run_profile.view.emplace().steps = profile_->take();
  }
  if (waits_) {
    run_profile.view->waits = waits_->take(waits_shown_max);
  }
  if (exchange_) {
    run_profile.view->exchange = std::move(exchange_);
  }
  if (fetches_) {
    run_profile.view->fetches = fetches_->take();
  }
  if (run_profile.view && !reference_logs_.empty()) {
    run_profile.view->misses = estimate_misses(reference_logs_);
  }
  if (order_.has_all_references) {
    run_profile.references = std::move(reference_logs_);
  }
  return run_profile;
}

}  // namespace dmpc::apps
