// Observer of page fetches, by node and page, and their times; its memory is no node's.
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

/// The parts of a fetch, from the moment in which a node begins to send a request to that in which its program takes the page,
/// without gaps. Where a runner does not report when a message arrives (threads), a wait counts as part of the transfer before
/// it.
enum class FetchPart : std::uint8_t {
  asking,       ///< the requester's processor sends the request
  request_way,  ///< the request is in transit
  home_wait,    ///< the request waits for the home
  service,      ///< the home looks the page up and sends it
  reply_way,    ///< the page is in transit
  reply_wait    ///< the page waits for the requester
};
inline constexpr std::array<std::string_view, 6> fetch_part_names = {
    "asking", "request on its way", "waiting for the home", "service", "page on its way", "waiting for the requester"};

/// One fetch, in nanoseconds. `home` is the node that served it, which in a tree is not always the page's home; passing its
/// request on counts as part of its transit.
struct Fetch {
  std::uint32_t requester = 0, home = 0, page = 0;
  std::array<std::uint64_t, fetch_part_names.size()> part_ns{};
  std::uint64_t links_ns = 0;  ///< waiting for links held by other messages, both ways (modelled machines)

  std::uint64_t total_ns() const;
};

/// The approximate number of fetches that are kept.
inline constexpr std::size_t fetch_sample_max = 100'000;

/// The result of a FetchObserver.
struct Fetches {
  std::uint32_t peer_count = 0;        ///< nodes, and the host, as the last, if it is home to all pages
  std::vector<std::uint64_t> by_pair;  ///< number of fetches of requester a that h served, at a * peer_count + h
  std::vector<std::uint64_t> by_page;  ///< number of fetches, by page
  /// One of `every`, a power of two, chosen by a hash of requester, home and the number of the fetch between them, sorted by
  /// requester, home and time; in a tree, where the node that is asked need not have the page, chosen by requester and page.
  std::vector<Fetch> sample;
  std::uint32_t every = 1;
  PageHomes where = PageHomes::spread;  ///< where pages are at home

  /// The home of a page.
  std::uint32_t home_of(std::uint32_t page) const {
    return are_at_host(where) ? peer_count - 1 : Homes(peer_count).place_of(PageId{page}).node;
  }
  /// The number of nodes that fetch a page from its home.
  std::uint32_t requester_count() const { return peer_count - 1; }
};

/// Observes the requests and replies of a run of svm. Thread safety: as an Observer; take() when the run is over.
class FetchObserver final : public nodes::Observer {
 public:
  /// `sample_max`: about this many fetches are kept; beyond that, half of them are repeatedly dropped.
  FetchObserver(std::uint32_t node_count, std::uint32_t page_count, std::size_t sample_max = fetch_sample_max,
                PageHomes where = PageHomes::spread);
  ~FetchObserver() override;

  void sent(const nodes::Passing& packet) override;
  void received(const nodes::Passing& packet) override;

  /// What was observed, for add() of the observer of another rank.
  std::string bytes() const;
  /// Adds what was observed on another rank, in times of this one.
  void add(std::string_view bytes, const nodes::ClockDrift& clock);

  /// The result; call it once.
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
