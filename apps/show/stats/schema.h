// stats.schema.json, which is installed: what each figure of --stats means, and that there are no others.
#pragma once

#include <string>

namespace dmpc::apps {

/// Made of stats.schema.in.json, which has in place of figures and options with rows the names of these; an object there lists
/// its keys and is meant to have all of them and no others.
const std::string& stats_schema();

}  // namespace dmpc::apps
