// How unevenly rays and pages are distributed over the nodes: by the positions of lights, and by the homes of pages.
#pragma once

#include "core/database/database.h"
#include "core/record/record.h"
#include "dataflow/run.h"
#include "svm/run.h"

namespace dmpc::apps {

/// Returns the finest cell of the grid that contains a light, or is nearest to it.
core::Corner cell_of_light(const core::DatabaseHeader& header, const core::LightRecord& light);

/// Returns the shadow rays that come to the region of a light from others, over the mean of all regions, for the light with the
/// most. 0 without lights, or if no shadow ray travels.
double shadow_flood(const core::Database& database, const dataflow::Report& report);

/// Returns the pages that a node sends, over the mean of all nodes, for the node that sends the most. 0 if no page travels.
double page_flood(const svm::Report& report);

}  // namespace dmpc::apps
