#include "apps/render/live_view.h"

#include <condition_variable>
#include <utility>
#include <vector>

#include "apps/frontend/run/work.h"
#include "apps/show/page/live_page.h"

namespace dmpc::apps {

namespace {

constexpr std::chrono::milliseconds look_interval{20};

constexpr std::size_t steps_max = 240;
/// Places of events.
enum : std::size_t { head_place, state_place, first_step, first_tile = first_step + steps_max };

}  // namespace

LiveView::LiveView(std::uint16_t port, const std::string& title, std::function<void()> stop)
    : server_(port, {.option = "--serve",
                     .page = html::live_page(title, html::LiveKind::run),
                     .important = first_tile,
                     .takes = {{"stop",
                                [stop = std::move(stop)](const std::string& /*json*/) {
                                  stop();
                                  return WebAnswer{.body = "It stops.\n"};
                                }}}}),
      steps_(steps_max),
      publisher_([this](const std::stop_token& stopping) { publish(stopping); }) {}

LiveView::~LiveView() { end({.said = "dmpc has ended before its picture was done."}); }

std::string LiveView::complaint() {
  const std::lock_guard lock(mutex_);
  return complaint_;
}

void LiveView::say(const std::string& phase) {
  const std::lock_guard lock(mutex_);
  phase_ = phase;
}

void LiveView::begin(const LiveHead& head, const core::PartialPicture* start) {
  const std::lock_guard lock(mutex_);
  head_ = head;
  if (picture_) {
    picture_->begin_again();
    if (counts_) {
      counts_->clear();
    }
  } else {
    picture_ = std::make_unique<LivePicture>(head.width, head.height, start);
    if (head.node_count > 0) {
      counts_ = std::make_unique<nodes::LiveCounts>(head.node_count + 1, work_of);
    }
  }
  steps_.clear();
  last_.reset();
  server_.feed().put(head_place, "head", json_of(head_, steps_max));
}

void LiveView::watch(const core::Film& film, const core::Refinement& pass, std::uint32_t pixel) {
  pass_.store(pass.result().passes, std::memory_order_relaxed);
  picture_->watch(film, pass, pixel);
}

void LiveView::update(std::uint32_t done, std::uint32_t total) {
  done_.store(done, std::memory_order_relaxed);
  total_.store(total, std::memory_order_relaxed);
}

/// Nobody would catch what leaves the thread: the picture goes on without viewers.
void LiveView::publish(const std::stop_token& stop) {
  try {
    std::mutex sleeping;
    std::condition_variable_any woken;
    std::unique_lock lock(sleeping);
    while (!woken.wait_for(lock, stop, LiveFeed::interval_usual, [] { return false; }) && !stop.stop_requested()) {
      publish_all();
    }
  } catch (const std::exception& error) {
    complain(error);
  }
}

/// What is new is made once for all. Steps are kept for those who come later; tiles wait until somebody looks on.
void LiveView::publish_all(bool is_last) {
  const std::lock_guard lock(mutex_);
  server_.feed().put(state_place, "state", json_of(state(is_last)));
  if (picture_ && server_.feed().seats_taken() > 0) {
    publish_tiles(picture_->take());
  }
}

/// With the mutex locked. The last has the shares of all that time.
LiveState LiveView::state(bool is_last) {
  const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_).count();
  LiveState state{.said = phase_,
                  .ms = static_cast<std::uint64_t>(passed),
                  .done = done_.load(std::memory_order_relaxed),
                  .total = total_.load(std::memory_order_relaxed),
                  .pass = pass_.load(std::memory_order_relaxed)};
  if (!counts_) {
    return state;
  }
  const std::vector<nodes::LiveNode> nodes = counts_->read();
  for (const nodes::LiveNode& node : nodes) {
    state.packets += node.packets_sent;
    state.bytes += node.bytes_sent;
  }
  LiveMoment moment(state.ms, nodes);
  state.ns = moment.ns;
  const LiveMoment* const before = is_last ? steps_.first() : last_ ? &*last_ : nullptr;
  if (before != nullptr && moment.ns > before->ns) {
    state.shares = shares_between(*before, moment);
  }
  if (!last_ || moment.ns > last_->ns) {
    last_ = moment;
  }
  publish_steps(std::move(moment));
  return state;
}

void LiveView::publish_steps(LiveMoment moment) {
  for (std::size_t step = steps_.add(std::move(moment)); step < steps_.count(); ++step) {
    server_.feed().put(first_step + step, "step", json_of(steps_, step, head_.frame));
  }
}

void LiveView::publish_tiles(const std::vector<PictureTile>& tiles) {
  for (const PictureTile& tile : tiles) {
    server_.feed().put(first_tile + tile.index, "tile", json_of(tile));
  }
}

void LiveView::show(const core::Film& film) {
  say("The picture is done.");
  picture_->take();
  publish_tiles(picture_->finish(film));
}

void LiveView::end(LiveEnd end, const std::stop_token& stop) {
  if (std::exchange(has_ended_, true)) {
    return;
  }
  publisher_.request_stop();
  publisher_.join();
  try {
    notify_end(std::move(end), stop);
  } catch (const std::exception& error) {
    complain(error);
  }
}

void LiveView::notify_end(LiveEnd end, const std::stop_token& stop) {
  say(end.said);
  publish_all(true);
  const std::string reported = json_of_end(end.said, end.figures, !end.page.empty());
  server_.end(reported,
              end.page.empty() ? std::nullopt : std::optional(PageServer::Page{std::move(end.page), "frame-ancestors 'none'"}),
              stop);
}

void LiveView::complain(const std::exception& error) {
  const std::lock_guard lock(mutex_);
  complaint_ = error.what();
}

void LiveView::wait(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::this_thread::sleep_for(look_interval);
  }
}

}  // namespace dmpc::apps
