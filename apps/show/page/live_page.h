// The page of --serve while the run goes on, and of `dmpc view`.
#pragma once

#include <string>

#include "apps/frontend/show/page/web_part.h"
#include "apps/frontend/web/page_server.h"

namespace dmpc::apps::html {

extern const WebPart live_style;   ///< live/live.css
extern const WebPart live_script;  ///< live/live.js

/// A run that is looked on at, or a scene that is looked round in.
enum class LiveKind { run, view };

/// The whole document, about what has this title. It asks its server for `events`, and sends it `stop` or a `camera`; its policy
/// allows what it has in itself, and that.
PageServer::Page live_page(const std::string& title, LiveKind kind);

}  // namespace dmpc::apps::html
