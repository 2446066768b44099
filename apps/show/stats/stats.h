// A render's counters as JSON with stable keys. Only stats.cpp and the files below it name nlohmann-json.
#pragma once

#include <string>

#include "apps/run/render_record.h"

namespace dmpc::apps {

/// Returns one indented JSON object with a line end. The keys are an interface: stats.schema.json, which is installed, defines
/// each and allows no other. Every key is always present; it is null if it does not apply, and no number is NaN or infinite.
std::string stats_json(const RenderRecord& record);

}  // namespace dmpc::apps
