// The page of --serve while the run goes on.
#pragma once

#include <string>

#include "apps/edge/show/page/web_part.h"

namespace dmpc::apps::html {

extern const WebPart live_style;   ///< live/live.css
extern const WebPart live_script;  ///< live/live.js

/// The whole document, about a run of this title. It asks its server for `events`.
std::string live_page(const std::string& title);

/// What a server is to say of its policy with it: what the page has in itself, and the events.
std::string live_policy();

}  // namespace dmpc::apps::html
