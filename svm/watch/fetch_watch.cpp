#include "svm/watch/fetch_watch.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "nodes/atomics.h"
#include "svm/packets.h"
#include "svm/share.h"

namespace dmpc::svm {

namespace {

/// A node keeps at least so many.
constexpr std::size_t log_max_least = 64;

/// The how many-th fetch of an asker from a home: both ends count, and both see the same order.
struct Name {
  std::uint32_t asker = 0, home = 0, ordinal = 0;

  std::uint64_t key() const { return core::mix(std::uint64_t{asker} << 32U | home) + ordinal; }
  auto operator<=>(const Name&) const = default;
};

/// What one of the two nodes knows of a fetch.
struct End {
  Name name;
  std::uint32_t page = 0;
  /// At the asker: begins to send the request, is done with it; the page arrives, is taken. At the home: the request arrives, is
  /// received; the reply has left.
  std::array<std::uint64_t, 4> time_ns{};
  std::uint64_t links_ns = 0;
};

/// Ends of fetches that are chosen, and those under way.
class Ends {
 public:
  void open(const End& end) {
    if (share_.has(end.name.key())) {
      open_[end.name] = end;
    }
  }
  /// Nothing if it was not chosen.
  End* find(const Name& name) {
    const auto found = open_.find(name);
    return found == open_.end() ? nullptr : &found->second;
  }
  /// The fetch is over, here.
  void close(const Name& name, std::size_t count_max) {
    closed_.push_back(open_.at(name));
    open_.erase(name);
    while (closed_.size() > count_max && !share_.is_least()) {
      thin_out(2 * share_.every());
    }
  }
  std::uint32_t every() const { return share_.every(); }
  /// Those of one of `every`, sorted.
  std::vector<End> take(std::uint32_t every) {
    thin_out(every);
    std::sort(closed_.begin(), closed_.end(), [](const End& a, const End& b) { return a.name < b.name; });
    return std::move(closed_);
  }

 private:
  void thin_out(std::uint32_t every) {
    share_.shrink_to(every);
    std::erase_if(closed_, [&](const End& end) { return !share_.has(end.name.key()); });
  }

  Share share_;
  std::map<Name, End> open_;  ///< as many as requests are under way
  std::vector<End> closed_;
};

std::uint32_t page_in(const nodes::Passing& packet) {
  std::uint32_t page = 0;
  std::memcpy(&page, packet.payload.data(), sizeof(page));  // of a request, and of a reply's header, the first
  return page;
}

bool is_kind(const nodes::Passing& packet, Kind kind) { return packet.kind == number_of(kind); }

/// When a message was at its target; without a clock on the way, when it was received.
std::uint64_t arrival_ns(const nodes::MessageTimes& times) {
  return times.arrived_ns == 0 ? times.received_ns : times.arrived_ns;
}

/// Both ends of one fetch.
Fetch joined(const End& asker, const End& home) {
  const auto& [asking, asked, page_arrives, page_taken] = asker.time_ns;
  const auto& [request_arrives, request_received, reply_left, unused] = home.time_ns;
  // The clocks of threads are read one after the other, so a difference may come out below zero.
  const auto between = [](std::uint64_t from, std::uint64_t to) { return to - std::min(from, to); };
  return {
      .asker = asker.name.asker,
      .home = asker.name.home,
      .page = asker.page,
      .part_ns = {between(asking, asked), between(asked, request_arrives), between(request_arrives, request_received),
                  between(request_received, reply_left), between(reply_left, page_arrives), between(page_arrives, page_taken)},
      .links_ns = asker.links_ns + home.links_ns};
}

}  // namespace

/// What one node has seen, on cache lines of its own.
struct alignas(nodes::cache_line_bytes) FetchWatch::Log {
  std::vector<std::uint32_t> asked, taken;            ///< by home
  std::vector<std::uint32_t> request_count, replied;  ///< by asker
  std::vector<std::uint32_t> by_slot;                 ///< of its home pages
  Ends as_asker, as_home;
};

std::uint64_t Fetch::total_ns() const { return std::accumulate(part_ns.begin(), part_ns.end(), std::uint64_t{0}); }

FetchWatch::FetchWatch(std::uint32_t node_count, std::uint32_t page_count, std::size_t sample_max, PageHomes where)
    : where_(where),
      homes_(homes_of(where, node_count)),
      peer_count_(std::max(node_count, homes_.end())),
      page_count_(page_count),
      log_max_(std::max(log_max_least, sample_max / (where == PageHomes::host ? 1 : node_count))) {
  for (std::uint32_t i = 0; i < peer_count_; ++i) {
    Log& log = *logs_.emplace_back(std::make_unique<Log>());
    for (auto* const counts : {&log.asked, &log.taken, &log.request_count, &log.replied}) {
      counts->resize(peer_count_);
    }
    log.by_slot.resize(homes_.count_at(i, page_count));
  }
}

FetchWatch::~FetchWatch() = default;

void FetchWatch::sent(const nodes::Passing& packet) {
  const std::uint32_t self = index_of(packet.node), peer = index_of(packet.peer);
  if (is_kind(packet, Kind::page_request)) {
    Log& log = *logs_[self];
    log.as_asker.open({.name = {self, peer, log.asked[peer]++},
                       .page = page_in(packet),
                       .time_ns = {packet.times.sending_ns, packet.times.left_ns}});
  } else if (is_kind(packet, Kind::page_reply)) {
    Log& log = *logs_[self];
    const Name name{peer, self, log.replied[peer]++};
    if (End* const end = log.as_home.find(name)) {
      end->time_ns[2] = packet.times.left_ns;
      log.as_home.close(name, log_max_);
    }
  }
}

void FetchWatch::received(const nodes::Passing& packet) {
  const std::uint32_t self = index_of(packet.node), peer = index_of(packet.peer);
  const nodes::MessageTimes& times = packet.times;
  if (is_kind(packet, Kind::page_request)) {
    Log& log = *logs_[self];
    ++log.by_slot[homes_.place_of(PageId{page_in(packet)}).slot];
    log.as_home.open({.name = {peer, self, log.request_count[peer]++},
                      .page = page_in(packet),
                      .time_ns = {arrival_ns(times), times.received_ns},
                      .links_ns = times.links_ns});
  } else if (is_kind(packet, Kind::page_reply)) {
    Log& log = *logs_[self];
    const Name name{self, peer, log.taken[peer]++};
    if (End* const end = log.as_asker.find(name)) {
      core::expect(end->page == page_in(packet), "pages come in the order in which one home was asked for them");
      end->time_ns[2] = arrival_ns(times);
      end->time_ns[3] = times.received_ns;
      end->links_ns = times.links_ns;
      log.as_asker.close(name, log_max_);
    }
  }
}

Fetches FetchWatch::take() {
  Fetches all{.peer_count = peer_count_, .by_pair = std::vector<std::uint64_t>(std::size_t{peer_count_} * peer_count_)};
  all.where = where_;
  all.by_page.resize(page_count_);
  for (const auto& log : logs_) {
    all.every = std::max({all.every, log->as_asker.every(), log->as_home.every()});
  }
  std::map<Name, End> homes;
  for (std::uint32_t node = 0; node < peer_count_; ++node) {
    const Log& log = *logs_[node];
    for (std::uint32_t asker = 0; asker < peer_count_; ++asker) {
      all.by_pair[std::size_t{asker} * peer_count_ + node] = log.request_count[asker];
    }
    for (std::size_t slot = 0; slot < log.by_slot.size(); ++slot) {
      all.by_page[index_of(homes_.page_at({node, static_cast<std::uint32_t>(slot)}))] = log.by_slot[slot];
    }
    for (const End& end : logs_[node]->as_home.take(all.every)) {
      homes.emplace(end.name, end);
    }
  }
  for (const auto& log : logs_) {
    for (const End& end : log->as_asker.take(all.every)) {
      if (const auto home = homes.find(end.name); home != homes.end()) {
        all.sample.push_back(joined(end, home->second));
      }
    }
  }
  return all;
}

}  // namespace dmpc::svm
