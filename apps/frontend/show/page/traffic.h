// Traffic between nodes: by kind of packet, and over the links of a modelled machine.
#pragma once

#include <span>
#include <string>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "nodes/counters.h"
#include "nodes/ranks/rank_figures.h"
#include "nodes/virtual/virtual_times.h"

namespace dmpc::apps::html {

/// Traffic of a kind of packet.
struct PacketKindTraffic {
  std::string kind;  ///< its name in words
  nodes::Traffic sent;
};

/// A row for each kind with traffic.
Table packet_table(std::span<const PacketKindTraffic> packets);

/// A row for each rank: its nodes, its memory beside theirs, and its traffic with other ranks.
Table rank_table(std::span<const nodes::RankFigures> ranks);

/// A row for each of the busiest links of a modelled machine.
Table link_table(const nodes::VirtualReport& report);
Plot link_plot();

/// The amount of traffic, its largest kind and, on a modelled machine, the load of the busiest link. `report` may be null.
std::string traffic_conclusion(std::span<const PacketKindTraffic> packets, const nodes::VirtualReport* report);
/// Distances of messages.
std::string way_text(const nodes::LinkTraffic& links);

}  // namespace dmpc::apps::html
