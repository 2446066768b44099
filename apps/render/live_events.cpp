#include "apps/render/live_events.h"

#include <nlohmann/json.hpp>

#include "apps/frontend/run/work.h"
#include "apps/frontend/system/base64.h"
#include "core/base/srgb.h"

namespace dmpc::apps {

namespace {

using Json = nlohmann::json;

/// On one line; bytes that are no text, of a file's name perhaps, are replaced.
std::string line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json tile_of(const PictureTile& tile) {
  std::string rgb;
  rgb.reserve(tile.rgb.size());
  for (const float value : tile.rgb) {
    rgb += static_cast<char>(core::srgb_byte(value));
  }
  return {{"x", tile.x}, {"y", tile.y}, {"width", tile.width}, {"height", tile.height}, {"rgb", base64(rgb)}};
}

}  // namespace

std::string json_of(const LiveHead& head, std::size_t steps_max) {
  return line({{"width", head.width},
               {"height", head.height},
               {"nodes", head.node_count},
               {"modelled", head.is_modelled},
               {"frame", head.frame},
               {"home", head.home},
               {"pivot", head.pivot},
               {"works", work_names},
               {"levels", LiveSteps::levels_max},
               {"steps", steps_max}});
}

std::string json_of(const LiveState& state) {
  return line({{"said", state.said},
               {"ms", state.ms},
               {"ns", state.ns},
               {"done", state.done},
               {"total", state.total},
               {"pass", state.pass},
               {"packets", state.packets},
               {"bytes", state.bytes},
               {"shares", state.shares}});
}

std::string json_of(const PictureTile& tile) { return line(tile_of(tile)); }

std::string json_of(const LiveShot& shot) {
  Json json = tile_of(shot.whole);
  json.update(
      {{"camera", shot.camera}, {"moving", shot.is_moving}, {"ms", shot.ms}, {"film", shot.film}, {"command", shot.command}});
  return line(json);
}

std::string json_of(const LiveSteps& steps, std::size_t step, std::uint64_t frame) {
  return line({{"frame", frame},
               {"doublings", steps.doublings()},
               {"step", step},
               {"ms", steps.end_ms(step)},
               {"cells", base64(steps.cells(step))}});
}

std::string json_of_end(const std::string& said, const std::string& figures, bool has_page) {
  return line({{"said", said}, {"figures", figures}, {"page", has_page}});
}

}  // namespace dmpc::apps
