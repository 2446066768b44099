// Decomposition of the nodes' time into computing and losses.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/run/time_parts.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "nodes/counters.h"
#include "nodes/virtual/virtual_times.h"

namespace dmpc::apps::html {

/// Each node's time in nanoseconds, by named parts, of which the first is computing.
struct Losses {
  std::vector<std::string> parts;
  std::vector<std::vector<std::uint64_t>> nodes;  ///< by node, each by part
  bool is_virtual = false;                        ///< virtual time, else wall clock
};

/// On a modelled machine: TimePart's, without parts that are zero on all nodes.
Losses virtual_losses(std::span<const nodes::VirtualTimes> nodes, const WaitKinds& waits);
/// The losses of threads: they compute, sleep for want of packets, or wait for a core.
Losses wall_losses(std::span<const nodes::NodeCounters> nodes);
/// Without parts that are zero on all nodes, except computing.
Losses without_empty_parts(const Losses& losses);

/// A row for each node, in percent that add up to 100 as shown, and one for all of them.
Table loss_table(const Losses& losses);
Plot loss_plot(const Losses& losses);
/// In a sentence or two.
std::string loss_conclusion(const Losses& losses);

}  // namespace dmpc::apps::html
