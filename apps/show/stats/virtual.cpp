#include "apps/show/stats/virtual.h"

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/time_parts.h"
#include "apps/run/render_record.h"

namespace dmpc::apps {
namespace {

/// Returns the nearest double, so that it prints with no more digits than it has.
double seconds(std::uint64_t ns) { return static_cast<double>(ns) / 1e9; }

/// `total_ns` is of the run; the others are of a node, or summed over the nodes.
Json times_json(std::uint64_t total_ns, const nodes::VirtualTimes& times, std::span<const char* const> kind_names) {
  Json waiting;
  for (std::size_t kind = 0; kind < kind_names.size(); ++kind) {
    waiting[kind_names[kind]] = seconds(times.waiting_ns[kind]);
  }
  return {{"total", seconds(total_ns)},
          {"computing", seconds(times.computing_ns)},
          {"sending", seconds(times.sending_ns)},
          {"receiving", seconds(times.receiving_ns)},
          {"service_busy", seconds(times.service_busy_ns)},
          {"service_idle", seconds(times.service_idle_ns)},
          {"waiting", waiting},
          {"end", seconds(times.end_ns)}};
}

Json percent_json(const TimeParts& parts) {
  Json result;
  const std::array<double, time_part_count> percent = parts.percent();
  for (std::size_t part = 0; part < time_part_count; ++part) {
    result[time_part_names[part]] = percent[part];
  }
  return result;
}

Json rows_json(const std::vector<nodes::LinkUse>& links) {
  Json rows = Json::array();
  for (const nodes::LinkUse& link : links) {
    rows.push_back({link.from, link.to, link.messages, link.bytes, seconds(link.busy_ns), seconds(link.wait_ns)});
  }
  return rows;
}

Json links_json(const nodes::VirtualReport& report) {
  const std::vector<nodes::LinkUse>& busiest = report.busiest_links;
  return {{"messages", report.links.messages},
          {"hops", report.links.hops},
          {"wait", seconds(report.links.wait_ns)},
          {"busiest", busiest.empty() ? 0.0 : seconds(busiest.front().busy_ns)},
          {"used", report.links_used},
          {"passages", report.links.passages},
          {"bytes", report.links.bytes},
          {"busy", seconds(report.links.busy_ns)},
          {"columns", {"from", "to", "messages", "bytes", "busy", "wait"}},
          {"rows", rows_json(busiest)}};
}

}  // namespace

VirtualStats virtual_stats(const Account& account, std::uint64_t film_hash) {
  VirtualStats stats;
  if (!account.virtual_time) {
    stats.nodes.assign(account.nodes.size(), Json::object());
    return stats;
  }
  const nodes::VirtualReport& report = *account.virtual_time;
  const auto times_of = [&](const nodes::VirtualTimes& times) -> Json {
    return {{"virtual_seconds", times_json(report.total_ns, times, account.kind_names)},
            {"time_percent", percent_json(parts_of(times, account.waits))}};
  };
  stats.all = {{"run_hash", hash_text(report.run_hash(film_hash))},
               {"machine_digest", hash_text(report.machine_digest)},
               {"events", report.events},
               {"links", links_json(report)}};
  stats.all.update(times_of(sum_of_nodes(report)));
  for (std::size_t node = 0; node < account.nodes.size(); ++node) {
    stats.nodes.push_back(times_of(report.nodes[node]));
  }
  stats.host = {{"virtual_seconds", times_of(report.nodes.back())["virtual_seconds"]}};
  return stats;
}

}  // namespace dmpc::apps
