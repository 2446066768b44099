// Pages travel: the number of requests, frames and slots that this takes.
#include <algorithm>

#include "core/base/units.h"
#include "svm/pages/observers/observed_pagers.h"
#include "svm/pages/pager.h"
#include "svm/program_maker.h"
#include "svm/strategy.h"

namespace dmpc::svm {
namespace {

/// While a task waits for a page, the node continues with others.
constexpr std::uint32_t default_tasks = modelled_in_flight, default_bundles = 4;
/// Between ranks a page takes several times as long, by way of two communicating threads.
constexpr std::uint32_t default_bundles_on_ranks = 16;
/// The approximate number of small slots that a home has for page requests; 16 KiB.
constexpr std::uint32_t request_slots_wanted = 256;
/// More requests to one home than this wait no less: it serves them one after another.
constexpr std::uint32_t request_credits_max = 4;

bool do_pages_travel(const PlanRequest& request) { return request.computer.node_count > 1 || are_at_host(request.pages.homes); }

/// The maximum number of nodes that request pages from one node: from the root, in a tree.
std::uint32_t askers_of(const PlanRequest& request) {
  const auto tree = request_tree_of(request.pages.homes, request.computer.node_count);
  return tree ? tree->count_below(0) : request.computer.node_count - 1;
}

class SvmStrategy final : public Strategy {
 public:
  const char* name() const override { return "svm"; }
  bool fetches_pages() const override { return true; }

  /// The default; where memory is bounded, frames are worth more than further tasks.
  std::uint32_t usual_tasks(const PlanRequest& request) const override {
    const bool may_be_more = do_pages_travel(request) && request.computer.ranks != nullptr && !request.computer.node_memory_bytes;
    return !request.bundles           ? default_tasks
           : request.computer.machine ? modelled_in_flight / bundle_pixels
           : may_be_more              ? default_bundles_on_ranks
                                      : default_bundles;
  }

  std::uint32_t foreign_pages_max(const PlanRequest& request) const override {
    if (!do_pages_travel(request)) {
      return 0;
    }
    return request.page_count - (are_at_host(request.pages.homes) ? 0 : request.page_count / request.computer.node_count);
  }

  /// At least one for each home, so that every fault is requested eventually; no more than faults, nor than pages at a home, each
  /// of which has at most one fault.
  std::uint32_t request_credits(const Plan& plan) const override {
    const PlanRequest& request = plan.request;
    if (!do_pages_travel(request)) {
      return 0;
    }
    const std::uint32_t requesters = askers_of(request);  // the host's memory is large
    const std::uint32_t each =
        requesters == 0 ? request_credits_max : std::clamp(request_slots_wanted / requesters, 1U, request_credits_max);
    const std::uint32_t homes = are_at_host(request.pages.homes) ? 1 : request.computer.node_count;
    return std::min({plan.faults_max(), core::ceil_divide(request.page_count, homes), each});
  }

  void add_slots(const Plan& plan, nodes::MailboxCapacity& capacity) const override {
    // Page requests: each other node's credits for this home, or, in a tree, those of all nodes below.
    capacity.small_slots += askers_of(plan.request) * plan.request_credits;
    if (do_pages_travel(plan.request)) {
      capacity.bulk_slots += plan.faults_max();  // page replies: one for each fault
      capacity.bulk_payload_bytes = std::max(capacity.bulk_payload_bytes, page_reply_bytes(plan.request.page_size_bytes));
    }
  }

  nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index) const override {
    const PageCapacity pages = plan.pages();
    nodes::MemoryPlan layout = Pager::layout(pages, index);
    if (plan.request.pages.count_pages) {
      layout += CountingPager::own_layout(pages);
    }
    return layout;
  }

  void for_each_piece(const Plan& plan, std::uint32_t index, const Visit& visit) const override {
    const PageCapacity pages = plan.pages();
    const std::size_t page_bytes = pages.page_size_bytes();
    HomePages::for_each_page(pages, index, [&](std::size_t offset) { visit(offset, page_bytes); });
    for (const PageId page : pages.resident) {
      visit(index_of(page) * page_bytes, page_bytes);
    }
  }

  MakeProgram maker(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                    const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs) const override {
    return plan.request.pages.count_pages ? maker_over<CountingPager>(plan, settings, database, watching, reference_logs)
           : reference_logs != nullptr    ? maker_over<RecordingPager>(plan, settings, database, watching, reference_logs)
                                          : maker_over<Pager, true>(plan, settings, database, watching, reference_logs);
  }
};

}  // namespace

const Strategy* svm_strategy() {
  static const SvmStrategy strategy;
  return &strategy;
}

}  // namespace dmpc::svm
