// What a render counted, as tables, and plots of them.
#pragma once

#include <vector>

#include "apps/frontend/show/page/losses.h"
#include "apps/frontend/show/page/traffic.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/run/render_record.h"
#include "apps/run/report.h"

namespace dmpc::apps::html {

/// A row for each node: what it did and what passed through it.
Table node_table(const RenderRecord& record);
std::vector<Plot> node_plots(const RenderRecord& record);

Losses losses_of(const Account& account);

/// A row for each node: bytes by category, as far as any node has some.
Table memory_table(const Account& account);
Plot memory_plot(const Account& account);

/// The packets of all nodes together.
std::vector<PacketKindTraffic> packets_of(const Account& account);

}  // namespace dmpc::apps::html
