// What was sent between nodes: by kind of packet, and over the links of a modelled machine.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "nodes/counters.h"
#include "nodes/ranks/rank_figures.h"
#include "nodes/virtual/virtual_times.h"

namespace dmpc::apps::html {

/// What was sent of a kind of packet.
struct PacketKindTraffic {
  std::string kind;  ///< its name in words
  nodes::Traffic sent;
};

/// A row for each kind that was sent.
Table packet_table(std::span<const PacketKindTraffic> packets);

/// A row for each rank: its nodes, what is set aside beside their memories, and what went between it and others.
Table rank_table(std::span<const nodes::RankFigures> ranks);

/// A row for each of the busiest links of a modelled machine.
Table link_table(const nodes::VirtualReport& report);
Plot link_plot();

/// How much was sent, what most of it was and, on a modelled machine, how busy its busiest link. `report` may be null.
std::string traffic_conclusion(std::span<const PacketKindTraffic> packets, const nodes::VirtualReport* report);
/// How far messages went.
std::string way_text(const nodes::LinkTraffic& links);

}  // namespace dmpc::apps::html
