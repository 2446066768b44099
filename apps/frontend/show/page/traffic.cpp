#include "apps/frontend/show/page/traffic.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/page/shares.h"
#include "core/base/ranges.h"

namespace dmpc::apps::html {

namespace {

/// So many of the links of a machine are shown; `--stats` has more.
constexpr std::size_t link_rows_max = 64;

std::vector<std::uint64_t> bytes_of(std::span<const PacketKindTraffic> packets) {
  std::vector<std::uint64_t> bytes;
  for (const PacketKindTraffic& kind : packets) {
    bytes.push_back(kind.sent.bytes);
  }
  return bytes;
}

}  // namespace

Table packet_table(std::span<const PacketKindTraffic> packets) {
  Table table("Packets by kind", {{"kind", "", 0}, {"packets", "", 0}, {"carried", "bytes", 0}, {"of all bytes", "%", 1}});
  const std::vector<double> percent = percent_parts(bytes_of(packets));
  for (std::size_t kind = 0; kind < packets.size(); ++kind) {
    if (const nodes::Traffic& sent = packets[kind].sent; sent.packets > 0) {
      table.add_row({packets[kind].kind, sent.packets, sent.bytes, percent[kind]});
    }
  }
  return table;
}

Table rank_table(std::span<const nodes::RankFigures> ranks) {
  Table table("Ranks", {{"rank", "", 0},
                        {"nodes", "", 0},
                        {"network memory", "KiB", 1},
                        {"packets sent", "", 0},
                        {"packets received", "", 0},
                        {"frames sent", "", 0},
                        {"sent", "bytes", 0},
                        {"clock wrong by at most", "us", 1}});
  for (const nodes::RankFigures& rank : ranks) {
    table.add_row({rank.name, std::uint64_t{rank.memory.node_count}, kibibytes(rank.memory.network.total()),
                   rank.traffic.packets_sent, rank.traffic.packets_received, rank.traffic.frames_sent, rank.traffic.bytes_sent,
                   static_cast<double>(rank.clock.error_ns()) / 1000});
  }
  return table;
}

Table link_table(const nodes::VirtualReport& report) {
  Table table("The busiest links", {{"link", "", 0},
                                    {"messages", "", 0},
                                    {"carried", "bytes", 0},
                                    {"held", "ms", 3},
                                    {"held in all", "%", 1},
                                    {"waited for", "ms", 3}});
  const std::size_t count = std::min(report.busiest_links.size(), link_rows_max);
  for (const nodes::LinkUse& link : std::span(report.busiest_links).first(count)) {
    const auto milliseconds = [](std::uint64_t ns) { return static_cast<double>(ns) / 1e6; };
    const double share =
        report.total_ns == 0 ? 0 : 100 * static_cast<double>(link.busy_ns) / static_cast<double>(report.total_ns);
    table.add_row(
        {link.from + " to " + link.to, link.messages, link.bytes, milliseconds(link.busy_ns), share, milliseconds(link.wait_ns)});
  }
  if (report.links_used > count) {
    table.add_note(std::to_string(count) + " of " + std::to_string(report.links_used) + " links that carried anything.");
  }
  return table;
}

Plot link_plot() {
  Plot plot = bars_by_node("links", "Traffic of the busiest links", {.label = "", .least = 0}, {{"carried", "carried"}}, false);
  plot.place = "link";
  plot.x = {};
  return plot;
}

std::string traffic_conclusion(std::span<const PacketKindTraffic> packets, const nodes::VirtualReport* report) {
  const std::vector<std::uint64_t> counted_bytes = bytes_of(packets);
  const std::vector<double> bytes(counted_bytes.begin(), counted_bytes.end());
  const double all_bytes = sum_of(bytes);
  const std::uint64_t all_packets =
      core::sum_over<std::uint64_t>(packets, [&](const PacketKindTraffic& kind) { return kind.sent.packets; });
  if (all_packets == 0) {
    return "No packet was sent.";
  }
  const std::size_t most = largest_at(bytes);
  std::string text = counted(all_packets, "packet") + ", " + amount_text(all_bytes, "bytes") + ", of which " +
                     share_text(share_of(bytes[most], all_bytes)) + " are of kind \"" + packets[most].kind + "\".";
  if (report != nullptr && !report->busiest_links.empty() && report->total_ns > 0) {
    const nodes::LinkUse& link = report->busiest_links.front();
    text += " The busiest link, from " + link.from + " to " + link.to + ", was held for " +
            share_text(share_of(static_cast<double>(link.busy_ns), static_cast<double>(report->total_ns))) + " of the run.";
  }
  return text;
}

std::string way_text(const nodes::LinkTraffic& links) {
  const double hops = links.messages == 0 ? 0 : static_cast<double>(links.hops) / static_cast<double>(links.messages);
  return counted(links.messages, "message") + " from one node to another passed " + fixed(hops, 2) + " links each, on average.";
}

}  // namespace dmpc::apps::html
