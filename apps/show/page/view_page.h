// The page of `dmpc view`.
#pragma once

#include <string>

#include "apps/edge/show/page/web_part.h"

namespace dmpc::apps::html {

extern const WebPart view_style;   ///< view/view.css
extern const WebPart view_script;  ///< view/camera.js, view/view.js

/// The whole document, about a view of this title. It asks its server for `events`, and sends it a `camera`.
std::string view_page(const std::string& title);

/// What a server is to say of its policy with it: what the page has in itself, and its server.
std::string view_policy();

}  // namespace dmpc::apps::html
