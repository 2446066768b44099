// What a render counted, as JSON with stable keys. Only stats.cpp and what it stands on name nlohmann-json.
#pragma once

#include <string>

#include "apps/run/render_record.h"

namespace dmpc::apps {

/// One JSON object, indented, with a line end. The keys are an interface: stats.schema.json, which is installed, says what each
/// means and allows no other. Every key is always there; what does not apply is null, and no number is NaN or infinite.
std::string stats_json(const RenderRecord& record);

}  // namespace dmpc::apps
