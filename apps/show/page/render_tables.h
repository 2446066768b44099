// What a render counted, as tables, and plots of them.
#pragma once

#include <vector>

#include "apps/run/render_record.h"
#include "apps/run/report.h"
#include "apps/table/plot.h"
#include "apps/table/table.h"

namespace dmpc::apps::html {

/// A row for each node: what it did and what passed through it.
Table node_table(const RenderRecord& record);
std::vector<Plot> node_plots(const RenderRecord& record);

/// A row for each node: where its time went, in percent that add up to 100 as they stand, and one for all of them. In virtual
/// time the parts are TimePart's; else what a thread does by the wall clock: it computes, sleeps for want of packets, or waits
/// for a core.
Table loss_table(const Account& account);
Plot loss_plot(const Account& account);

/// A row for each node: bytes by category, as far as any node has some.
Table memory_table(const Account& account);
Plot memory_plot(const Account& account);

/// A row for each kind of packet that was sent.
Table packet_table(const Account& account);

/// A row for each rank: its nodes, what is set aside beside their memories, and what went between it and others.
Table rank_table(const Account& account);

/// A row for each of the busiest links of a modelled machine.
Table link_table(const nodes::VirtualReport& report);
Plot link_plot();

}  // namespace dmpc::apps::html
