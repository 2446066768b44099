#include "apps/frontend/show/page/losses.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/page/shares.h"
#include "core/base/ranges.h"

namespace dmpc::apps::html {

namespace {

/// The losses of all nodes, by part.
std::vector<std::uint64_t> sum_of_parts(const Losses& losses) {
  std::vector<std::uint64_t> sum(losses.parts.size());
  for (const std::vector<std::uint64_t>& node : losses.nodes) {
    std::transform(sum.begin(), sum.end(), node.begin(), sum.begin(), std::plus());
  }
  return sum;
}

void add_shares(Table& table, const std::string& name, std::span<const std::uint64_t> parts) {
  std::vector<Cell> row = {name};
  for (const double percent : percent_parts(parts)) {
    row.emplace_back(percent);
  }
  table.add_row(std::move(row));
}

bool has_part(const Losses& losses, std::string_view name) {
  return std::find(losses.parts.begin(), losses.parts.end(), name) != losses.parts.end();
}

std::string note_on(const Losses& losses) {
  if (!losses.is_virtual) {
    return "Wall clock. Asleep: waiting for packets. The nodes share this computer's cores, and those of a pool their threads.";
  }
  const bool has_service = has_part(losses, service_busy_words) || has_part(losses, service_idle_words);
  return std::string("Virtual time.") + (has_service ? " Service while busy and service while idle: requests of others served "
                                                       "while the node had other work, and while it had none."
                                                     : "");
}

std::string virtual_conclusion(const Losses& losses, std::span<const double> parts) {
  const double whole = sum_of(parts);
  if (whole == 0) {
    return "No virtual time passed.";
  }
  std::string text = "The nodes computed for " + share_text(share_of(parts[0], whole)) + " of their time";
  if (parts.size() > 1) {
    if (const std::size_t loss = 1 + largest_at(parts.subspan(1)); parts[loss] > 0) {
      text += "; most of the rest was \"" + losses.parts[loss] + "\", " + share_text(share_of(parts[loss], whole));
    }
  }
  const std::vector<double> computing =
      core::mapped<double>(losses.nodes, [&](const std::vector<std::uint64_t>& node) { return static_cast<double>(node[0]); });
  const std::string even = evenness(computing, "computed for");
  return text + "." + (even.empty() ? "" : " " + even + ".");
}

/// The conclusion from wall_losses().
std::string wall_conclusion(std::span<const double> parts) {
  const double whole = sum_of(parts);
  if (whole == 0) {
    return "No time passed.";
  }
  return "The nodes computed for " + share_text(share_of(parts[0], whole)) + " of their time, slept without packets for " +
         share_text(share_of(parts[1], whole)) + " and waited for a core of this computer, or for their turn in a pool, for " +
         share_text(share_of(parts[2], whole)) + ".";
}

}  // namespace

Losses virtual_losses(std::span<const nodes::VirtualTimes> nodes, const WaitKinds& waits) {
  Losses losses{.is_virtual = true};
  for (std::size_t part = 0; part < time_part_count; ++part) {
    losses.parts.push_back(words_of(static_cast<TimePart>(part), waits));
  }
  for (const nodes::VirtualTimes& times : nodes) {
    const TimeParts parts = parts_of(times, waits);
    losses.nodes.emplace_back(parts.ns.begin(), parts.ns.end());
  }
  return without_empty_parts(losses);
}

Losses wall_losses(std::span<const nodes::NodeCounters> nodes) {
  Losses losses{.parts = {"computing", "asleep", "waiting for a core"}};
  for (const nodes::NodeCounters& counters : nodes) {
    const std::uint64_t known_ns = counters.busy_ns + counters.asleep_ns;
    losses.nodes.push_back({counters.busy_ns, counters.asleep_ns, counters.wall_ns - std::min(counters.wall_ns, known_ns)});
  }
  return losses;
}

Losses without_empty_parts(const Losses& losses) {
  const std::vector<std::uint64_t> sum = sum_of_parts(losses);
  Losses found{
      .parts = {}, .nodes = std::vector<std::vector<std::uint64_t>>(losses.nodes.size()), .is_virtual = losses.is_virtual};
  for (std::size_t part = 0; part < sum.size(); ++part) {
    if (part == 0 || sum[part] > 0) {
      found.parts.push_back(losses.parts[part]);
      for (std::size_t node = 0; node < losses.nodes.size(); ++node) {
        found.nodes[node].push_back(losses.nodes[node][part]);
      }
    }
  }
  return found;
}

Table loss_table(const Losses& losses) {
  std::vector<Column> columns = {{"node", "", 0}};
  for (const std::string& name : losses.parts) {
    columns.push_back({name, "%", 1});
  }
  Table table("Where each node's time went", std::move(columns));
  for (std::size_t node = 0; node < losses.nodes.size(); ++node) {
    add_shares(table, std::to_string(node), losses.nodes[node]);
  }
  add_shares(table, "all", sum_of_parts(losses));
  table.add_note(note_on(losses));
  return table;
}

Plot loss_plot(const Losses& losses) {
  return stacked_by_node("losses", "Where each node's time went", {.label = "of its time (%)", .least = 0, .most = 100},
                         loss_table(losses).columns());
}

std::string loss_conclusion(const Losses& losses) {
  const std::vector<std::uint64_t> sum = sum_of_parts(losses);
  const std::vector<double> parts(sum.begin(), sum.end());
  return losses.is_virtual ? virtual_conclusion(losses, parts) : wall_conclusion(parts);
}

}  // namespace dmpc::apps::html
