// Which pages were fetched by whom, and what the fetches took: an instrument beside the computer, whose memory is no node's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nodes/observer.h"
#include "nodes/ranks/clock_drift.h"
#include "svm/pages/home.h"

namespace dmpc::svm {

/// From the moment in which a node begins to send a request to that in which its program takes the page: the parts follow each
/// other without a gap. Where a runner does not tell when a message arrives (threads), a wait counts as part of the way before
/// it.
enum class FetchPart : std::uint8_t {
  asking,       ///< the requester's processor sends the request
  request_way,  ///< the request travels
  home_wait,    ///< it waits for the home
  service,      ///< the home looks the page up and sends it
  reply_way,    ///< the page travels
  reply_wait    ///< it waits for the requester
};
inline constexpr std::array<std::string_view, 6> fetch_part_names = {
    "asking", "request on its way", "waiting for the home", "service", "page on its way", "waiting for the requester"};

/// One fetch, in nanoseconds. `home` is who served it, which in a tree is not always the page's home; what others do to pass its
/// request on is part of its way.
struct Fetch {
  std::uint32_t requester = 0, home = 0, page = 0;
  std::array<std::uint64_t, fetch_part_names.size()> part_ns{};
  std::uint64_t links_ns = 0;  ///< of both ways, waiting for links that others held (modelled machines)

  std::uint64_t total_ns() const;
};

/// About so many fetches are kept in all.
inline constexpr std::size_t fetch_sample_max = 100'000;

/// What a watch has seen.
struct Fetches {
  std::uint32_t peer_count = 0;        ///< nodes, and the host if it is home to all pages, the last
  std::vector<std::uint64_t> by_pair;  ///< counted: those of requester a that h served, at a * peer_count + h
  std::vector<std::uint64_t> by_page;  ///< counted, by number
  /// One of `every`, a power of two, chosen by a hash of who asks whom for the how many-th time, sorted by requester, home and
  /// time; in a tree, where who is asked need not have the page, by one of requester and page.
  std::vector<Fetch> sample;
  std::uint32_t every = 1;
  PageHomes where = PageHomes::spread;  ///< pages are at home

  /// The home of a page.
  std::uint32_t home_of(std::uint32_t page) const {
    return are_at_host(where) ? peer_count - 1 : Homes(peer_count).place_of(PageId{page}).node;
  }
  /// How many fetch a page that is at home elsewhere.
  std::uint32_t requester_count() const { return peer_count - 1; }
};

/// Watches the requests and replies of a run of svm. Thread safety: as an Observer; take() when the run is over.
class FetchObserver final : public nodes::Observer {
 public:
  /// `sample_max`: about so many fetches are kept in all; of more, every second is forgotten, again and again.
  FetchObserver(std::uint32_t node_count, std::uint32_t page_count, std::size_t sample_max = fetch_sample_max,
                PageHomes where = PageHomes::spread);
  ~FetchObserver() override;

  void sent(const nodes::Passing& packet) override;
  void received(const nodes::Passing& packet) override;

  /// What was seen of nodes, for add() of the watch of another rank.
  std::string bytes() const;
  /// Takes over what was seen of nodes that are on another rank, in times of this one.
  void add(std::string_view bytes, const nodes::ClockDrift& clock);

  /// What was seen; call it once.
  Fetches take();

 private:
  struct Log;

  PageHomes where_;
  std::uint32_t peer_count_;
  std::uint32_t page_count_;
  std::size_t log_max_;
  std::vector<Log> logs_;
};

}  // namespace dmpc::svm
