// What the page of `view` sends and is told, one JSON text each, as its script (apps/show/page/view/view.js) reads it.
#pragma once

#include <cstdint>
#include <string>

#include "apps/scene/staging.h"

namespace dmpc::apps {

/// A camera that somebody wants to look through.
struct Wish {
  CameraChoice camera;     ///< whole
  bool is_moving = false;  ///< it will not stay: a quarter of the pixels will do
};

/// Reads {"camera": "FROM/AT/UP/DEGREES", "moving": false}, the camera as --camera takes it. Throws core::UsageError, a sentence,
/// for anything else.
Wish wish_in(const std::string& json);

/// What does not change.
struct ViewHead {
  std::uint32_t width = 0, height = 0;  ///< of pictures of a camera that rests
  std::string home;                     ///< the camera at first
  std::string pivot;                    ///< about which it turns: a point on its line of sight
};

/// What goes on.
struct ViewState {
  std::string said;  ///< as a sentence
  std::uint32_t done = 0, total = 0;
};

/// One that is done.
struct ViewPicture {
  std::string camera;
  bool is_moving = false;
  std::uint32_t width = 0, height = 0;
  std::string rgb;  ///< bytes of sRGB, row by row
  double ms = 0;    ///< how long it took
  std::string film, command;
};

std::string json_of(const ViewHead& head);
std::string json_of(const ViewState& state);
std::string json_of(const ViewPicture& picture);
std::string json_of_view_end(const std::string& said);

}  // namespace dmpc::apps
