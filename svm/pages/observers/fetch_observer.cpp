#include "svm/pages/observers/fetch_observer.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "nodes/atomics.h"
#include "nodes/flat_bytes.h"
#include "svm/pages/packets.h"
#include "svm/pages/share.h"

namespace dmpc::svm {

namespace {

/// The minimum number that a node keeps.
constexpr std::size_t log_max_least = 64;

/// The ordinal of a fetch among those of a requester from a home: both ends count, and both see the same order. In a tree, where
/// the server is not known beforehand, `home` is the page: a requester fetches it once at a time, and all of its fetches are
/// numbered at the end.
struct Name {
  std::uint32_t requester = 0, home = 0, ordinal = 0;

  std::uint64_t key() const { return core::mix(std::uint64_t{requester} << 32U | home) + ordinal; }
  auto operator<=>(const Name&) const = default;
};

/// What one of the two nodes knows about a fetch.
struct End {
  Name name;
  std::uint32_t page = 0;
  std::uint32_t home = 0;  ///< who serves; known only at that end
  /// At the requester: the request's sending begins, ends; the page arrives, is taken. At the home: the request arrives, is
  /// received; the reply has left.
  std::array<std::uint64_t, 4> time_ns{};
  std::uint64_t links_ns = 0;
};

/// Ends of the sampled fetches, and those in flight.
class Ends {
 public:
  void open(const End& end) {
    if (share_.has(end.name.key())) {
      open_[end.name] = end;
    }
  }
  /// Nothing if the fetch was not chosen.
  End* find(const Name& name) {
    const auto found = open_.find(name);
    return found == open_.end() ? nullptr : &found->second;
  }
  /// Another node will serve it.
  void drop(const Name& name) { open_.erase(name); }
  /// The fetch is finished at this end.
  void close(const Name& name, std::size_t count_max) {
    closed_.push_back(open_.at(name));
    open_.erase(name);
    while (closed_.size() > count_max && !share_.is_least()) {
      thin_out(2 * share_.every());
    }
  }
  std::uint32_t every() const { return share_.every(); }
  bool is_empty() const { return closed_.empty() && share_.every() == 1; }
  /// Serialises the fetches that have ended.
  void put(nodes::FlatWriter& flat) const {
    flat.put(share_.every());
    flat.put_all(closed_);
  }
  void take(nodes::FlatReader& flat, const nodes::ClockDrift& clock) {
    share_.shrink_to(flat.take<std::uint32_t>());
    closed_ = flat.take_all<End>();
    for (End& end : closed_) {
      std::transform(end.time_ns.begin(), end.time_ns.end(), end.time_ns.begin(),
                     [&](std::uint64_t time_ns) { return clock.corrected(time_ns); });
    }
  }
  /// Takes one fetch of `every`.
  std::vector<End> take(std::uint32_t every) {
    thin_out(every);
    return std::move(closed_);
  }

 private:
  void thin_out(std::uint32_t every) {
    share_.shrink_to(every);
    std::erase_if(closed_, [&](const End& end) { return !share_.has(end.name.key()); });
  }

  Share share_;
  std::map<Name, End> open_;  ///< as many as requests in flight
  std::vector<End> closed_;
};

std::uint32_t word_in(const nodes::Passing& packet, std::size_t index) {
  std::uint32_t word = 0;
  std::memcpy(&word, packet.payload.data() + index * sizeof(word), sizeof(word));
  return word;
}

/// The page of a request, and of a reply's header.
std::uint32_t page_in(const nodes::Passing& packet) { return word_in(packet, 0); }

/// The requester of a request that is passed on.
std::uint32_t requester_in(const nodes::Passing& packet) { return word_in(packet, 1); }

/// `count`: the number so far for this requester and home at the requesting end.
Name name_of_next(PageHomes where, std::uint32_t requester, std::uint32_t home, std::uint32_t page, std::uint32_t& count) {
  return where == PageHomes::tree ? Name{requester, page, 0} : Name{requester, home, count++};
}

bool is_kind(const nodes::Passing& packet, Kind kind) { return packet.kind == number_of(kind); }

/// A request or a reply. Others may pass the host, which is no home where pages are distributed, and begin with no page.
bool is_of_fetch(const nodes::Passing& packet) {
  return is_kind(packet, Kind::page_request) || is_kind(packet, Kind::passed_request) || is_kind(packet, Kind::page_reply);
}

/// When a message was at its target; without a clock on the way, when it was received.
std::uint64_t arrival_ns(const nodes::MessageTimes& times) {
  return times.arrived_ns == 0 ? times.received_ns : times.arrived_ns;
}

/// Sorted; ends with the same name are distinguished by their begin.
std::vector<End> numbered(std::vector<End> ends) {
  std::sort(ends.begin(), ends.end(),
            [](const End& a, const End& b) { return std::tie(a.name, a.time_ns) < std::tie(b.name, b.time_ns); });
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const Name& before = ends[i - 1].name;
    Name& name = ends[i].name;
    if (name.requester == before.requester && name.home == before.home && name.ordinal <= before.ordinal) {
      name.ordinal = before.ordinal + 1;
    }
  }
  return ends;
}

Fetch joined(const End& requester, const End& home) {
  const auto& [asking, asked, page_arrives, page_taken] = requester.time_ns;
  const auto& [request_arrives, request_received, reply_left, unused] = home.time_ns;
  // The clocks of threads are read one after the other, so a difference may be negative.
  const auto between = [](std::uint64_t from, std::uint64_t to) { return to - std::min(from, to); };
  return {
      .requester = requester.name.requester,
      .home = home.home,
      .page = requester.page,
      .part_ns = {between(asking, asked), between(asked, request_arrives), between(request_arrives, request_received),
                  between(request_received, reply_left), between(reply_left, page_arrives), between(page_arrives, page_taken)},
      .links_ns = requester.links_ns + home.links_ns};
}

/// Counts by number of the page or node.
using Counts = std::map<std::uint32_t, std::uint64_t>;

void put_counts(nodes::FlatWriter& flat, const Counts& counts) {
  flat.put(counts.size());
  for (const auto& [number, count] : counts) {
    flat.put(number);
    flat.put(count);
  }
}

Counts take_counts(nodes::FlatReader& flat) {
  Counts counts;
  for (auto left = flat.take<std::size_t>(); left > 0; --left) {
    const auto number = flat.take<std::uint32_t>();
    counts[number] = flat.take<std::uint64_t>();
  }
  return counts;
}

}  // namespace

/// The observations of one node, on separate cache lines.
struct alignas(nodes::cache_line_bytes) FetchObserver::Log {
  std::vector<std::uint32_t> asked, taken;        ///< by the node asked, and by the replying node
  std::vector<std::uint32_t> requested, replied;  ///< by requester
  Counts by_page, by_requester;                   ///< requests that are not passed on
  Ends as_requester, as_home;

  bool is_empty() const { return by_page.empty() && as_requester.is_empty() && as_home.is_empty(); }
  void put(nodes::FlatWriter& flat) const {
    put_counts(flat, by_page);
    put_counts(flat, by_requester);
    as_requester.put(flat);
    as_home.put(flat);
  }
  void take(nodes::FlatReader& flat, const nodes::ClockDrift& clock) {
    by_page = take_counts(flat);
    by_requester = take_counts(flat);
    as_requester.take(flat, clock);
    as_home.take(flat, clock);
  }

  void count(std::uint32_t requester, std::uint32_t page, int change) {
    by_page[page] += static_cast<std::uint64_t>(change);
    by_requester[requester] += static_cast<std::uint64_t>(change);
  }
};

std::uint64_t Fetch::total_ns() const { return std::accumulate(part_ns.begin(), part_ns.end(), std::uint64_t{0}); }

FetchObserver::FetchObserver(std::uint32_t node_count, std::uint32_t page_count, std::size_t sample_max, PageHomes where)
    : where_(where),
      peer_count_(homes_of(where, node_count).end()),
      page_count_(page_count),
      log_max_(std::max(log_max_least, sample_max / (are_at_host(where) ? 1 : node_count))),
      logs_(peer_count_) {
  for (Log& log : logs_) {
    for (auto* const counts : {&log.asked, &log.taken, &log.requested, &log.replied}) {
      counts->resize(peer_count_);
    }
  }
}

FetchObserver::~FetchObserver() = default;

void FetchObserver::sent(const nodes::Passing& packet) {
  if (!is_of_fetch(packet)) {
    return;
  }
  const std::uint32_t self = index_of(packet.node), peer = index_of(packet.peer), page = page_in(packet);
  Log& log = logs_.at(self);
  if (is_kind(packet, Kind::page_request)) {
    log.as_requester.open({.name = name_of_next(where_, self, peer, page, log.asked[peer]),
                           .page = page,
                           .time_ns = {packet.times.sending_ns, packet.times.left_ns}});
  } else if (is_kind(packet, Kind::passed_request)) {
    log.count(requester_in(packet), page, -1);
    log.as_home.drop({requester_in(packet), page, 0});
  } else {
    const Name name = name_of_next(where_, peer, self, page, log.replied[peer]);
    if (End* const end = log.as_home.find(name)) {
      end->time_ns[2] = packet.times.left_ns;
      log.as_home.close(name, log_max_);
    }
  }
}

void FetchObserver::received(const nodes::Passing& packet) {
  if (!is_of_fetch(packet)) {
    return;
  }
  const std::uint32_t self = index_of(packet.node), peer = index_of(packet.peer);
  const nodes::MessageTimes& times = packet.times;
  Log& log = logs_.at(self);
  const bool is_passed = is_kind(packet, Kind::passed_request);
  if (is_passed || is_kind(packet, Kind::page_request)) {
    const std::uint32_t requester = is_passed ? requester_in(packet) : peer, page = page_in(packet);
    log.count(requester, page, 1);
    log.as_home.open({.name = name_of_next(where_, requester, self, page, log.requested[requester]),
                      .page = page,
                      .home = self,
                      .time_ns = {arrival_ns(times), times.received_ns},
                      .links_ns = times.links_ns});
  } else {
    const Name name = name_of_next(where_, self, peer, page_in(packet), log.taken[peer]);
    if (End* const end = log.as_requester.find(name)) {
      core::expect(end->page == page_in(packet), "pages come in the order in which one home was asked for them");
      end->time_ns[2] = arrival_ns(times);
      end->time_ns[3] = times.received_ns;
      end->links_ns = times.links_ns;
      log.as_requester.close(name, log_max_);
    }
  }
}

std::string FetchObserver::bytes() const {
  nodes::FlatWriter flat;
  for (std::uint32_t index = 0; index < logs_.size(); ++index) {
    if (!logs_[index].is_empty()) {
      flat.put(index);
      logs_[index].put(flat);
    }
  }
  return flat.take();
}

void FetchObserver::add(std::string_view bytes, const nodes::ClockDrift& clock) {
  nodes::FlatReader flat(bytes);
  while (!flat.is_at_end()) {
    Log& log = logs_.at(flat.take<std::uint32_t>());
    core::expect(log.is_empty(), "a node is on one rank");
    log.take(flat, clock);
  }
}

Fetches FetchObserver::take() {
  Fetches all{.peer_count = peer_count_, .by_pair = std::vector<std::uint64_t>(std::size_t{peer_count_} * peer_count_)};
  all.where = where_;
  all.by_page.resize(page_count_);
  for (Log& log : logs_) {
    all.every = std::max({all.every, log.as_requester.every(), log.as_home.every()});
  }
  std::vector<End> ends;
  for (std::uint32_t node = 0; node < peer_count_; ++node) {
    Log& log = logs_[node];
    for (const auto& [requester, count] : log.by_requester) {
      all.by_pair[std::size_t{requester} * peer_count_ + node] = count;
    }
    for (const auto& [page, count] : log.by_page) {
      all.by_page[page] += count;
    }
    const std::vector<End> more = log.as_home.take(all.every);
    ends.insert(ends.end(), more.begin(), more.end());
  }
  std::map<Name, End> homes;
  for (const End& end : numbered(std::move(ends))) {
    homes.emplace(end.name, end);
  }
  for (Log& log : logs_) {
    for (const End& end : numbered(log.as_requester.take(all.every))) {
      if (const auto home = homes.find(end.name); home != homes.end()) {
        all.sample.push_back(joined(end, home->second));
      }
    }
  }
  return all;
}

}  // namespace dmpc::svm
