// What a render's page says first: three sentences from the run's counters, each with a link to its plot.
#pragma once

#include <vector>

#include "apps/frontend/show/page/page.h"
#include "apps/run/render_record.h"
#include "apps/run/report.h"

namespace dmpc::apps::html {

/// Returns what most of the nodes' time was lost by; of threads only what they know.
Finding time_finding(const Account& account);

/// Returns where the nodes' time went, what their traffic was (for pages, what a larger cache would change), and how evenly they
/// worked. The account is the record's.
std::vector<Finding> findings_of(const RenderRecord& record, const Account& account);

}  // namespace dmpc::apps::html
