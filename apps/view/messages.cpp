#include "apps/view/messages.h"

#include <nlohmann/json.hpp>

#include "apps/edge/show/page/data_url.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

constexpr const char* form = R"(expected JSON such as {"camera": "1,2,3/0,0,0/0,1,0/45", "moving": false})";

/// On one line; bytes that are no text, of a file's name perhaps, are replaced.
std::string message_of(const nlohmann::json& json) { return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace); }

}  // namespace

Wish wish_in(const std::string& json) {
  const auto read = nlohmann::json::parse(json, nullptr, false);
  const bool is_object = read.is_object() && read.size() == 2 && read.contains("camera") && read.contains("moving");
  if (!is_object || !read["camera"].is_string() || !read["moving"].is_boolean()) {
    throw core::UsageError(form);
  }
  const CameraChoice camera = parse_camera(read["camera"].get<std::string>(), "camera");
  if (!camera.up || !camera.degrees) {
    throw core::UsageError(std::string("the camera lacks its up or its angle: ") + form);
  }
  return {.camera = camera, .is_moving = read["moving"].get<bool>()};
}

std::string json_of(const ViewHead& head) {
  return message_of({{"width", head.width}, {"height", head.height}, {"home", head.home}, {"pivot", head.pivot}});
}

std::string json_of(const ViewState& state) {
  return message_of({{"said", state.said}, {"done", state.done}, {"total", state.total}});
}

std::string json_of(const ViewPicture& picture) {
  return message_of({{"camera", picture.camera},
                     {"moving", picture.is_moving},
                     {"width", picture.width},
                     {"height", picture.height},
                     {"rgb", html::base64(picture.rgb)},
                     {"ms", picture.ms},
                     {"film", picture.film},
                     {"command", picture.command}});
}

std::string json_of_view_end(const std::string& said) { return message_of({{"said", said}}); }

}  // namespace dmpc::apps
