// The results of `dmpc info` as text.
#pragma once

#include <string>

namespace dmpc::apps {

struct InfoRecord;

/// Returns labelled lines, then tables in Markdown: records, textures if there are any, memory by strategy and nodes.
std::string info_text(const InfoRecord& record);

}  // namespace dmpc::apps
