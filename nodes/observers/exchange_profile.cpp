#include "nodes/observers/exchange_profile.h"

#include <algorithm>
#include <charconv>
#include <functional>

namespace dmpc::nodes {

namespace {

// The maximum number of rows, all pairs of 127 nodes and a host, and of steps; the last half of a run has at least half.
constexpr std::size_t row_max = std::size_t{1} << 14U, pair_step_count_max = 32, step_count_max = 64;

}  // namespace

ExchangeProfile::ExchangeProfile(const ExchangeChoice& choice)
    : choice_(choice),
      topology_(choice.topology, choice.node_count, choice.uplinks),
      pairs_((choice.node_count + 1) * (choice.node_count + 1), row_max, pair_step_count_max),
      numbers_(choice.number_count, row_max, step_count_max),
      links_(static_cast<std::uint32_t>(row_max), row_max, step_count_max),
      levels_(choice.node_count * static_cast<std::uint32_t>(Levels::count_max), row_max, step_count_max),
      links_from_(topology_.place_count() + 1),
      levels_now_(choice.node_count) {}

void ExchangeProfile::received(const Passing& packet) {
  pass_links(packet);
  if ((choice_.pair_kinds >> packet.kind & 1U) == 0) {
    return;
  }
  const std::uint64_t at_ns = packet.times.arrived_ns;
  pairs_.add(index_of(packet.node) * (choice_.node_count + 1) + index_of(packet.peer), at_ns, 1);
  if (const std::uint32_t number = packet.first_word(); choice_.number_count > 0) {
    numbers_.add(number, at_ns, 1);
  }
}

void ExchangeProfile::pass_links(const Passing& packet) {
  const NodeId host{choice_.node_count}, door{0};
  if (packet.node == packet.peer) {
    return;
  }
  route_.clear();
  if (packet.peer == host) {
    route_.push_back({host_place(), index_of(door)});
  }
  topology_.append_route(packet.peer == host ? door : packet.peer, packet.node == host ? door : packet.node, route_);
  if (packet.node == host) {
    route_.push_back({index_of(door), host_place()});
  }
  for (const Link& link : route_) {
    if (const std::uint32_t number = number_of(link); number < row_max) {
      links_.add(number, packet.times.arrived_ns, sizeof(PacketHeader) + packet.payload_bytes());
    }
  }
}

/// A link gets a number when a message first passes it.
std::uint32_t ExchangeProfile::number_of(const Link& link) {
  std::vector<LinkTo>& from_place = links_from_[link.from];
  const auto at = std::lower_bound(from_place.begin(), from_place.end(), link.to,
                                   [](const LinkTo& known, std::uint32_t to) { return known.to < to; });
  if (at != from_place.end() && at->to == link.to) {
    return at->number;
  }
  from_place.insert(at, {link.to, link_count_});
  return link_count_++;
}

/// The place by its name in Links; an invalid place for a memory port.
std::uint32_t ExchangeProfile::place_of(std::string_view name) const {
  const std::size_t space = name.find(' ');
  if (space == std::string_view::npos) {
    return host_place();
  }
  const std::string_view what = name.substr(0, space), digits = name.substr(space + 1);
  std::uint32_t number = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return what == "memory" ? host_place() + 1 : what == "switch" ? choice_.node_count + number : number;
}

std::span<const std::uint64_t> ExchangeProfile::link_bytes(std::string_view from, std::string_view to) const {
  const std::uint32_t begin = place_of(from), end = place_of(to);
  if (begin >= links_from_.size()) {
    return {};
  }
  for (const LinkTo& known : links_from_[begin]) {
    if (known.to == end && known.number < row_max) {
      return links_.row(known.number);
    }
  }
  return {};
}

/// A level keeps its value until it is reported again.
void ExchangeProfile::ended(const Span& span, const Program& program) {
  const std::uint32_t node = index_of(span.node);
  if (node >= choice_.node_count || !span.is_own_call()) {
    return;
  }
  LevelsNow& now = levels_now_[node];
  std::size_t number = 0;
  for (const Level& level : program.levels()) {
    if (number == level_names_.size()) {
      level_names_.emplace_back(level.name);
    }
    const std::uint32_t row = node * static_cast<std::uint32_t>(Levels::count_max) + static_cast<std::uint32_t>(number);
    for (std::uint64_t at_ns = now.time_ns; now.values[number] > 0 && at_ns < span.end_ns; at_ns += levels_.step_ns()) {
      levels_.raise(row, at_ns, now.values[number]);
    }
    if (const std::uint64_t most = std::max(now.values[number], level.value); most > 0) {
      levels_.raise(row, span.end_ns, most);
    }
    now.values[number++] = level.value;
  }
  now.time_ns = span.end_ns;
}

std::vector<std::uint64_t> ExchangeProfile::level_sums(std::size_t level) const {
  std::vector<std::uint64_t> sums(levels_.step_count_max());
  for (std::size_t node = 0; node < levels_now_.size(); ++node) {
    const auto row = levels_.row(static_cast<std::uint32_t>(node * Levels::count_max + level));
    std::transform(row.begin(), row.end(), sums.begin(), sums.begin(), std::plus());
  }
  return sums;
}

}  // namespace dmpc::nodes
