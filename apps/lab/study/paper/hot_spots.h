// How unevenly what travels comes to the nodes: where the lights are, and where pages are at home.
#pragma once

#include "core/database/database.h"
#include "core/record/record.h"
#include "dataflow/run.h"
#include "svm/run.h"

namespace dmpc::apps {

/// The finest cell of the grid that a light lies in, or that is nearest to it.
core::Corner cell_of_light(const core::DatabaseHeader& header, const core::LightRecord& light);

/// Shadow rays that come to the region of a light from others, over the mean of all regions: of the light with the most. 0
/// without lights, and where no shadow ray travels.
double shadow_flood(const core::Database& database, const dataflow::Report& report);

/// Pages that a node sends, over the mean of all nodes: of the node that sends most. 0 where no page travels.
double page_flood(const svm::Report& report);

}  // namespace dmpc::apps
