// The page of --serve during a run, and of `dmpc view`.
#pragma once

#include <string>

#include "apps/frontend/show/page/web_part.h"
#include "apps/frontend/web/page_server.h"

namespace dmpc::apps::html {

extern const WebPart live_style;   ///< live/live.css
extern const WebPart live_script;  ///< live/live.js

/// A run that is observed, or a scene that is viewed interactively.
enum class LiveKind { run, view };

/// Returns the whole document with this title. It requests `events` from its server, and sends it `stop` or a `camera`; its
/// policy allows only its own contents and these requests.
PageServer::Page live_page(const std::string& title, LiveKind kind);

}  // namespace dmpc::apps::html
