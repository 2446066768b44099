// What shows runs as they went, where the reader lets scripts run: the sources in apps/show/page/play, as they are.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/frontend/show/page/page.h"

namespace dmpc::apps::html {

/// `data`: play_data() of a run, or {"runs": [...]} of two, each with a "name", which play on one clock. Only the
/// scripts go into the page that draw something of theirs.
void add_player(Page& page, const nlohmann::json& data);

/// As it stands in a page: in ASCII, texts that are no UTF-8 mended.
std::string data_text(const nlohmann::json& data);

}  // namespace dmpc::apps::html
