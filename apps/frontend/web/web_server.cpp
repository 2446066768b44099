#include "apps/frontend/web/web_server.h"

namespace dmpc::apps {

const WebLibrary& web_library() {
  static const auto* const library =
      static_cast<const WebLibrary*>(open_module("http", "shows a picture in a browser while it is rendered"));
  return *library;
}

}  // namespace dmpc::apps
