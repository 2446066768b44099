#include "apps/view/wishes.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

constexpr const char* form = R"(expected JSON such as {"camera": "1,2,3/0,0,0/0,1,0/45", "moving": false})";

}  // namespace

Wish wish_in(const std::string& json) {
  const auto read = nlohmann::json::parse(json, nullptr, false);
  const bool is_object = read.is_object() && read.contains("camera") && read.contains("moving");
  const bool is_final = is_object && read.contains("render") && read["render"] == true;
  if (!is_object || read.size() != (is_final ? 3 : 2) || !read["camera"].is_string() || !read["moving"].is_boolean()) {
    throw core::UsageError(form);
  }
  const CameraChoice camera = parse_camera(read["camera"].get<std::string>(), "camera");
  if (!camera.up || !camera.degrees) {
    throw core::UsageError(std::string("the camera lacks its up or its angle: ") + form);
  }
  return {.camera = camera, .is_moving = read["moving"].get<bool>(), .is_final = is_final};
}

WebAnswer Wishes::take(const std::string& json) {
  constexpr int bad_request = 400;
  try {
    const Wish wish = wish_in(json);
    const std::lock_guard lock(mutex_);
    wish_ = wish_ && wish_->is_final ? wish_ : wish;
    under_way_.request_stop();
    changed_.notify_all();
    return {.body = "It comes.\n"};
  } catch (const core::UsageError& error) {
    return {.status = bad_request, .body = std::string(error.what()) + "\n"};
  }
}

std::optional<Wish> Wishes::next(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  under_way_ = std::stop_source(std::nostopstate);
  const bool is_there = changed_.wait(lock, stop, [this] { return wish_.has_value(); });
  return is_there && !stop.stop_requested() ? std::exchange(wish_, {}) : std::nullopt;
}

void Wishes::stop_at_next(std::stop_source source) {
  const std::lock_guard lock(mutex_);
  under_way_ = std::move(source);
  if (wish_) {
    under_way_.request_stop();
  }
}

}  // namespace dmpc::apps
