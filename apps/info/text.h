// What `dmpc info` found out, for people.
#pragma once

#include <string>

namespace dmpc::apps {

struct InfoRecord;

/// Lines with a word in front, then tables in Markdown: records, textures if there are any, memory by strategy and nodes.
std::string info_text(const InfoRecord& record);

}  // namespace dmpc::apps
