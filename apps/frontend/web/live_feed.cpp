#include "apps/frontend/web/live_feed.h"

#include <algorithm>
#include <utility>

namespace dmpc::apps {

namespace {

/// That a viewer is gone is found out when something is sent.
constexpr std::chrono::seconds silence_max{5};

/// EventSource passes over it.
const auto remark = std::make_shared<const std::string>(":\n\n");

std::shared_ptr<const std::string> event_of(std::string_view name, std::string_view data) {
  auto event = std::make_shared<std::string>("event: ");
  event->append(name).append("\ndata: ").append(data).append("\n\n");
  return event;
}

}  // namespace

void LiveFeed::put(std::size_t place, std::string_view name, std::string_view data) {
  Event event = event_of(name, data);
  const std::lock_guard lock(mutex_);
  if (place >= places_.size()) {
    places_.resize(place + 1);
  }
  places_[place] = {std::move(event), ++version_};
}

void LiveFeed::close(std::string_view name, std::string_view data) {
  Event event = event_of(name, data);
  const std::lock_guard lock(mutex_);
  if (!last_) {
    last_ = std::move(event);
  }
  closed_.notify_all();
}

std::shared_ptr<const void> LiveFeed::take_seat(std::size_t seats) {
  const std::size_t before = taken_.fetch_add(1, std::memory_order_relaxed);
  std::shared_ptr<const void> seat(this, [this](const void*) { taken_.fetch_sub(1, std::memory_order_relaxed); });
  return before < seats ? seat : nullptr;
}

/// With the mutex locked. Once the feed is closed, all there is.
std::vector<LiveFeed::Event> LiveFeed::news(Viewer& viewer) const {
  viewer.seen.resize(places_.size());
  std::vector<Event> events;
  const auto take = [&](std::size_t place) -> std::size_t {
    if (viewer.seen[place] == places_[place].version) {
      return 0;
    }
    viewer.seen[place] = places_[place].version;
    events.push_back(places_[place].event);
    return events.back()->size();
  };
  const std::size_t first = std::min(important_, places_.size()), others = places_.size() - first;
  for (std::size_t place = 0; place < first; ++place) {
    take(place);
  }
  std::size_t bytes = 0;
  for (std::size_t looks = 0; looks < others && (bytes < bytes_at_once_ || last_); ++looks) {
    bytes += take(first + viewer.next);
    viewer.next = (viewer.next + 1) % others;
  }
  if (last_) {
    events.push_back(last_);
  }
  return events;
}

/// Until it is time to look again. Nobody is woken by each event: of many events and many viewers that would take more time than
/// to send them.
void LiveFeed::wait() {
  std::unique_lock lock(mutex_);
  closed_.wait_for(lock, interval_, [this] { return last_ != nullptr; });
}

void LiveFeed::follow(WebStream& viewer) {
  Viewer state;
  auto last = std::chrono::steady_clock::now();
  for (bool is_last = false; !is_last; wait()) {
    std::vector<Event> events;
    {
      const std::lock_guard lock(mutex_);
      is_last = last_ != nullptr;
      events = news(state);
    }
    const auto now = std::chrono::steady_clock::now();
    if (events.empty() && now - last >= silence_max) {
      events.push_back(remark);
    }
    for (const Event& event : events) {
      if (!viewer.send(*event)) {
        return;
      }
      last = now;
    }
  }
}

}  // namespace dmpc::apps
