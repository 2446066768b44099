#include "apps/frontend/web/page_server.h"

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

/// For pages: a stream holds a thread.
constexpr std::size_t other_threads = 4;
constexpr std::chrono::seconds timeout_at_the_end{2};
constexpr std::chrono::milliseconds look_interval{20};
constexpr int not_found = 404, wrong_method = 405, wrong_type = 415, come_later = 503;

const char* why_refused(int status) {
  return status == wrong_method ? "Only GET and POST are answered here.\n"
         : status == wrong_type ? "Requests to this page are JSON, with exactly the type application/json.\n"
         : status == come_later ? "Nothing is here yet.\n"
                                : "This page needs the whole address, as dmpc printed it.\n";
}

std::string why_not(const std::string& option, std::uint16_t port, int error) {
  const std::string named =
      option + "=" + std::to_string(port) + ": this port of 127.0.0.1 cannot be opened: " + std::strerror(error);
  return port == 0 ? named : named + "; give another, from 1024 on, or " + option + "=0, which takes a free one";
}

}  // namespace

PageServer::PageServer(std::uint16_t port, Service service)
    : service_(std::move(service)), feed_(service_.important, LiveFeed::bytes_usual, service_.interval), page_(service_.page) {
  // Nobody knows the token before it is said, so that nothing can be asked before there is a gate.
  const std::string token = random_token();
  server_ =
      web_library().listen({.port = port, .threads = viewers_max + other_threads, .answer = [this](const WebRequest& request) {
                              return answer(request);
                            }});
  if (!server_) {
    throw core::InputError(why_not(service_.option, port, errno));
  }
  const std::lock_guard lock(mutex_);
  gate_.emplace(token, server_->port());
}

void PageServer::end(std::string_view json, std::optional<Page> last, const std::stop_token& stop) {
  const std::size_t viewers = feed_.seats_taken();
  const bool has_last = last.has_value();
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(has_ended_, true)) {
      return;
    }
    if (has_last) {
      page_ = std::move(*last);
    }
  }
  feed_.close("end", json);
  const auto have_all = [&] {
    const std::lock_guard lock(mutex_);
    return has_last ? given_since_ >= viewers : feed_.seats_taken() == 0;
  };
  const auto deadline = std::chrono::steady_clock::now() + timeout_at_the_end;
  while (!have_all() && std::chrono::steady_clock::now() < deadline && !stop.stop_requested()) {
    std::this_thread::sleep_for(look_interval);
  }
}

WebAnswer PageServer::answer(const WebRequest& request) {
  std::string place;
  {
    const std::lock_guard lock(mutex_);
    const int refusal = gate_ ? gate_->refusal(request) : come_later;
    if (refusal != 0) {
      return {.status = refusal, .body = why_refused(refusal)};
    }
    place = gate_->place_of(request);
  }
  return answer_at(place, request);
}

WebAnswer PageServer::answer_at(const std::string& place, const WebRequest& request) {
  if (request.brings_json) {
    const auto take = service_.takes.find(place);
    return take != service_.takes.end() ? take->second(request.json)
                                        : WebAnswer{.status = wrong_method, .body = "Nothing is sent here.\n"};
  }
  if (place == "events") {
    return events();
  }
  return place.empty() ? page() : WebAnswer{.status = not_found, .body = "There is nothing here.\n"};
}

WebAnswer PageServer::events() {
  has_had_visitors_.store(true, std::memory_order_relaxed);
  std::shared_ptr<const void> seat = feed_.take_seat(viewers_max);
  if (!seat) {
    return {.status = come_later,
            .body = std::to_string(viewers_max) + " viewers are connected already, and there can be no more.\n"};
  }
  return {.type = "text/event-stream",
          .body = "",
          .headers = {{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}},
          .stream = [this, seat = std::move(seat)](WebStream& viewer) { feed_.follow(viewer); }};
}

WebAnswer PageServer::page() {
  has_had_visitors_.store(true, std::memory_order_relaxed);
  Page page;
  {
    const std::lock_guard lock(mutex_);
    page = page_;
    given_since_ += has_ended_ ? 1 : 0;
  }
  return {.type = "text/html; charset=utf-8",
          .body = std::move(page.html),
          .headers = {{"Cache-Control", "no-store"},
                      {"Referrer-Policy", "no-referrer"},
                      {"X-Content-Type-Options", "nosniff"},
                      {"X-Frame-Options", "DENY"},
                      {"Cross-Origin-Resource-Policy", "same-origin"},
                      {"Content-Security-Policy", std::move(page.policy)}}};
}

}  // namespace dmpc::apps
