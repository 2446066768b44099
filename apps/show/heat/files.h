// What stands in the files of --heatmap.
#pragma once

#include <string>

#include "apps/run/heat_options.h"
#include "apps/run/render_record.h"

namespace dmpc::apps {

/// All bytes of the file that is asked for; record.heat has its kind. Throws core::InputError if its format cannot hold it.
std::string heat_file(const HeatRequest& request, const RenderRecord& record);

}  // namespace dmpc::apps
