#include "apps/view/view_server.h"

#include <chrono>
#include <utility>

#include "apps/show/page/view_page.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// Places of events, all of which a viewer gets at once.
enum : std::size_t { head_place, state_place, picture_place, places };

/// Pictures of a moving camera come as fast as they are made.
constexpr std::chrono::milliseconds look_interval{15};
constexpr std::chrono::milliseconds patience_at_the_end{2000};

}  // namespace

ViewServer::ViewServer(std::uint16_t port, const std::string& title)
    : title_(title), feed_(places, LiveFeed::bytes_usual, look_interval) {
  server_.emplace(port, "--port", feed_,
                  PageServer::Service{.page =
                                          [this] {
                                            return PageServer::Page{html::view_page(title_), html::view_policy()};
                                          },
                                      .takes = {{"camera", [this](const std::string& json) { return take(json); }}}});
}

ViewServer::~ViewServer() {
  tell_end("dmpc has ended.");
  server_.reset();
}

void ViewServer::tell(const ViewHead& head) { feed_.put(head_place, "head", json_of(head)); }
void ViewServer::tell(const ViewState& state) { feed_.put(state_place, "state", json_of(state)); }
void ViewServer::tell(const ViewPicture& picture) { feed_.put(picture_place, "picture", json_of(picture)); }
void ViewServer::tell_end(const std::string& said) {
  feed_.close("end", json_of_view_end(said));
  feed_.see_off(patience_at_the_end);
}

WebAnswer ViewServer::take(const std::string& json) {
  constexpr int bad_request = 400;
  try {
    const Wish wish = wish_in(json);
    const std::lock_guard lock(mutex_);
    wish_ = wish;
    under_way_.request_stop();
    changed_.notify_all();
    return {.body = "It comes.\n"};
  } catch (const core::UsageError& error) {
    return {.status = bad_request, .body = std::string(error.what()) + "\n"};
  }
}

std::optional<Wish> ViewServer::take_wish(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  under_way_ = std::stop_source(std::nostopstate);
  const bool is_there = changed_.wait(lock, stop, [this] { return wish_.has_value(); });
  return is_there && !stop.stop_requested() ? std::exchange(wish_, {}) : std::nullopt;
}

void ViewServer::stop_at_next_wish(std::stop_source source) {
  const std::lock_guard lock(mutex_);
  under_way_ = std::move(source);
  if (wish_) {
    under_way_.request_stop();
  }
}

}  // namespace dmpc::apps
