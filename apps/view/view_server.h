// The page of `view`: who looks round is shown pictures, and says from where the next is to be.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "apps/edge/web/live_feed.h"
#include "apps/edge/web/page_server.h"
#include "apps/view/messages.h"

namespace dmpc::apps {

/// Keeps the newest wish of all who look on, and gives all of them the newest picture. Takes 4/3 bytes a byte of a picture, and
/// as much of each viewer while it is sent.
///
/// Thread safety: any thread; one at a time waits for wishes.
class ViewServer {
 public:
  /// As PageServer, whose option is --port.
  ViewServer(std::uint16_t port, const std::string& title);
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;
  ~ViewServer();

  std::string address() const { return server_->address(); }

  void tell(const ViewHead& head);
  void tell(const ViewState& state);
  void tell(const ViewPicture& picture);
  /// Nothing follows; who looks on is told why, for which two seconds are left. Only the first call counts.
  void tell_end(const std::string& said);

  /// Waits for a wish that was not taken yet, the newest; nothing once a stop is requested.
  std::optional<Wish> take_wish(const std::stop_token& stop);
  /// From now on this is stopped at the next wish, or now if one waits.
  void stop_at_next_wish(std::stop_source source);

 private:
  WebAnswer take(const std::string& json);

  const std::string title_;
  LiveFeed feed_;
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any changed_;
  std::optional<Wish> wish_;
  std::stop_source under_way_{std::nostopstate};
  std::optional<PageServer> server_;  ///< ends before what its threads use
};

}  // namespace dmpc::apps
