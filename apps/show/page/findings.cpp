#include "apps/show/page/findings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/run_view.h"
#include "apps/frontend/show/page/shares.h"
#include "apps/frontend/show/page/traffic.h"
#include "apps/frontend/show/page/view_conclusions.h"
#include "apps/show/page/conclusions.h"
#include "apps/show/page/render_tables.h"

namespace dmpc::apps::html {

namespace {

/// Returns how nodes lost time; empty if the part is no loss.
std::string verb_of(TimePart part, const WaitKinds& waits) {
  switch (part) {
    case TimePart::data_wait:
      return std::string("waited for ") + waits.data + "s";
    case TimePart::starvation:
      return "waited for work";
    case TimePart::token_wait:
      return "waited for the token that proves the end";
    case TimePart::credit_wait:
      return "waited for credits";
    case TimePart::film_wait:
      return "waited for the host to take pixels";
    case TimePart::other_wait:
      return "waited for other messages";
    case TimePart::service_busy:
      return "served the requests of others";
    case TimePart::messages:
      return "sent and received messages";
    case TimePart::idle_at_end:
      return "idled at the end";
    default:
      return "";
  }
}

/// Time that all nodes together took, and lost most by one thing.
struct SpentTime {
  double computing = 0, whole = 0;  ///< sums over all nodes
  double lost = 0;
  std::string lost_by = {};

  void add_loss(double ns, const std::string& verb) {
    if (ns > lost && !verb.empty()) {
      lost = ns;
      lost_by = verb;
    }
  }
};

SpentTime virtual_time(const Account& account) {
  const TimeParts parts = parts_of(sum_of_nodes(*account.virtual_time), account.waits);
  SpentTime time{.computing = static_cast<double>(parts.ns[static_cast<std::size_t>(TimePart::computing)]),
                 .whole = static_cast<double>(parts.total_ns())};
  for (std::size_t part = 0; part < time_part_count; ++part) {
    time.add_loss(static_cast<double>(parts.ns[part]), verb_of(static_cast<TimePart>(part), account.waits));
  }
  return time;
}

/// A thread knows no more than whether it computes, sleeps, or waits for a core.
SpentTime wall_time(const Account& account) {
  constexpr std::array verbs = {"", "slept for want of packets", "waited for a core of this computer"};
  SpentTime time;
  std::array<double, verbs.size()> sums{};
  for (const std::vector<std::uint64_t>& node : losses_of(account).nodes) {
    for (std::size_t part = 0; part < verbs.size(); ++part) {
      sums[part] += static_cast<double>(node[part]);
    }
  }
  for (std::size_t part = 0; part < verbs.size(); ++part) {
    time.whole += sums[part];
    time.add_loss(sums[part], verbs[part]);
  }
  time.computing = sums[0];
  return time;
}

Finding traffic_finding(const RenderRecord& record, const Account& account) {
  if (const auto* const report = std::get_if<svm::Report>(&record.report);
      report != nullptr && record.view != nullptr && record.view->misses && report->pages().faults > 0) {
    if (std::string text = larger_cache_sentence(*record.view->misses, report->plan.frames); !text.empty()) {
      return {std::move(text), "plot-misses"};
    }
  }
  if (const auto* const report = std::get_if<dataflow::Report>(&record.report)) {
    return {ray_conclusion(report->ray_matrix(), account.operations.ray_count()), "Rays between nodes"};
  }
  return {traffic_conclusion(packets_of(account), account.virtual_time ? &*account.virtual_time : nullptr), "Traffic"};
}

}  // namespace

Finding time_finding(const Account& account) {
  const SpentTime time = account.virtual_time ? virtual_time(account) : wall_time(account);
  const std::size_t count = account.nodes.size();
  const std::string whole = account.virtual_time ? amount_text(static_cast<double>(account.virtual_time->total_ns), "ns")
                                                 : "their time by the wall clock";
  std::string text =
      counted(count, "node") + " computed for " + share_text(share_of(time.computing, time.whole)) + " of " + whole;
  if (time.lost > 0) {
    text += "; the largest loss: " + std::string(count == 1 ? "it " : "they ") + time.lost_by + " for " +
            share_text(share_of(time.lost, time.whole));
  }
  return {text + ".", "plot-losses"};
}

std::vector<Finding> findings_of(const RenderRecord& record, const Account& account) {
  return {time_finding(account), traffic_finding(record, account), {node_conclusion(account), "plot-node_rays"}};
}

}  // namespace dmpc::apps::html
