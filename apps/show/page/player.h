// Plays runs in a page if the reader allows scripts, with the sources in apps/show/page/play.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "apps/frontend/show/page/page.h"

namespace dmpc::apps::html {

/// `data`: play_data() of a run, or {"runs": [...]} of two, each with a "name", which play on one clock. Only scripts that draw
/// something of these data go into the page.
void add_player(Page& page, const nlohmann::json& data);

/// Returns the data as in a page: in ASCII, with invalid UTF-8 repaired.
std::string data_text(const nlohmann::json& data);

}  // namespace dmpc::apps::html
