// What those who look round want to see: the newest wish of all of them.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "apps/frontend/web/web_server.h"
#include "apps/scene/scene_setup.h"

namespace dmpc::apps {

/// A camera that somebody wants to look through.
struct Wish {
  CameraChoice camera;     ///< whole
  bool is_moving = false;  ///< it will not stay: a quarter of the pixels will do
  bool is_final = false;   ///< dmpc render is to take it from here
};

/// Reads {"camera": "FROM/AT/UP/DEGREES", "moving": false}, the camera as --camera takes it; with "render": true it is final.
/// Throws core::UsageError, a sentence, for anything else.
Wish wish_in(const std::string& json);

/// Thread safety: any thread; one at a time waits for wishes.
class Wishes {
 public:
  /// What the page has sent, which in the answer is refused, with a sentence, or comes.
  WebAnswer take(const std::string& json);
  /// Waits for a wish that was not had yet, the newest; nothing once a stop is requested.
  std::optional<Wish> next(const std::stop_token& stop);
  /// From now on this is stopped at the next wish, or now if one waits.
  void stop_at_next(std::stop_source source);

 private:
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any changed_;
  std::optional<Wish> wish_;
  std::stop_source under_way_{std::nostopstate};
};

}  // namespace dmpc::apps
