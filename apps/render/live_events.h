// The events for viewers, as their page's script (apps/show/page/live/live.js) reads them: one JSON text per event.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/render/live_picture.h"
#include "apps/render/live_steps.h"

namespace dmpc::apps {

/// Constant data of a picture.
struct LiveHead {
  std::uint32_t width = 0, height = 0;
  std::uint32_t node_count = 0;  ///< nodes whose activity is shown; 0: none
  bool is_modelled = false;
  std::uint64_t frame = 0;            ///< number of the frame; 0 for a single picture
  std::string home = {}, pivot = {};  ///< for a movable camera: its first position, and the point around which it turns
};

/// The state of a render.
struct LiveState {
  std::string said;      ///< the state as a sentence
  std::uint64_t ms = 0;  ///< wall clock
  std::uint64_t ns = 0;  ///< on the nodes' clock
  std::uint32_t done = 0, total = 0, pass = 1;
  std::uint64_t packets = 0, bytes = 0;  ///< sent by nodes
  std::vector<double> shares = {};       ///< the nodes' time since the last step, by kind of work; empty: none has passed
};

/// A finished picture of several.
struct LiveShot {
  PictureTile whole;
  std::string camera;
  bool is_moving = false;  ///< the camera moves: the picture has fewer pixels
  double ms = 0;           ///< its rendering time
  std::string film, command;
};

std::string json_of(const LiveHead& head, std::size_t steps_max = 0);
std::string json_of(const LiveState& state);
/// As bytes of sRGB in base64.
std::string json_of(const PictureTile& tile);
std::string json_of(const LiveShot& shot);
/// A step of a frame as base64.
std::string json_of(const LiveSteps& steps, std::size_t step, std::uint64_t frame);
/// The end, with lines of `figures`. `has_page`: another page is now available at the same address.
std::string json_of_end(const std::string& said, const std::string& figures = "", bool has_page = false);

}  // namespace dmpc::apps
