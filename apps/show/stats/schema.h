// stats.schema.json, which is installed: it defines each figure of --stats, and that there are no others.
#pragma once

#include <string>

namespace dmpc::apps {

/// The schema is made from stats.schema.in.json, which in place of figures and options with rows has their names; an object there
/// lists its keys and is meant to have all of them and no others.
const std::string& stats_schema();

}  // namespace dmpc::apps
