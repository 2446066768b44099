// A render's counters as tables, and plots of them.
#pragma once

#include <vector>

#include "apps/frontend/show/page/losses.h"
#include "apps/frontend/show/page/traffic.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/run/render_record.h"
#include "apps/run/report.h"

namespace dmpc::apps::html {

/// Returns a row for each node: its activities and its traffic.
Table node_table(const RenderRecord& record);
std::vector<Plot> node_plots(const RenderRecord& record);

Losses losses_of(const Account& account);

/// Returns a row for each node: bytes by category, without categories that no node uses.
Table memory_table(const Account& account);
Plot memory_plot(const Account& account);

std::vector<PacketKindTraffic> packets_of(const Account& account);

}  // namespace dmpc::apps::html
