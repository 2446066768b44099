// What the page of a render is built of beyond what any page is: the sources in apps/show/page/play, as they are.
#pragma once

#include "apps/edge/show/page/web_part.h"

namespace dmpc::apps::html {

extern const WebPart play_style;   ///< play.css
extern const WebPart play_script;  ///< all scripts there, one after the other

}  // namespace dmpc::apps::html
