// Three nodes and a host as packets and queues, without rays' geometry: what a ray does where it is traced is left open, up to a
// bounded number of children in all, so every scene's behaviour with that many rays is among those explored.
//
// The decisions are those of dataflow/flow_control.h and dataflow/termination.h, reached through `Rules`, so that a test can
// break one of them. A step is one quantum of a node or of the host, or the reception of the oldest packet of one (sender,
// target) pair.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "dataflow/flow_control.h"
#include "dataflow/termination.h"
#include "tests/dataflow/peers_model.h"

namespace dmpc::tests {

/// The rules as they are. Broken ones derive from this and hide a member.
struct ProtocolRules {
  using Termination = dataflow::Termination;
  static constexpr dataflow::Task next_task(const dataflow::NodeState& state) { return dataflow::next_task(state); }
  static constexpr bool is_passive(const dataflow::NodeState& state) { return dataflow::is_passive(state); }
  static constexpr dataflow::Way way_of(bool owner, bool queue, bool host) { return dataflow::way_of(owner, queue, host); }
  static constexpr bool forwards(std::uint64_t kept, bool credit) { return dataflow::forwards(kept, credit); }
  static constexpr bool returns_credits(std::uint32_t owed, std::uint32_t batch, bool rests) {
    return dataflow::returns_credits(owed, batch, rests);
  }
  static constexpr bool must_close(std::uint32_t open, std::uint32_t open_max) { return dataflow::must_close(open, open_max); }
  static constexpr bool asks(bool rays, bool credit, bool asked) { return dataflow::asks(rays, credit, asked); }
  static constexpr bool may_ask(std::uint32_t asked, std::uint32_t asks_max) { return dataflow::may_ask(asked, asks_max); }
  static constexpr bool host_is_passive(std::uint64_t kept) { return dataflow::host_is_passive(kept); }
  /// With a host that buffers as many rays as it may.
  static constexpr bool admits_primaries(std::uint32_t queued, std::uint32_t capacity) {
    return dataflow::admits_primaries(queued, capacity, dataflow::host_rays_wanted_max);
  }
  static constexpr bool declines(bool rays, bool credit) { return dataflow::declines(rays, credit); }
  static constexpr bool grants(std::uint32_t free, bool is_asked) { return dataflow::grants(free, is_asked); }
};

struct ProtocolSettings {
  std::array<std::uint8_t, model_nodes> primaries{1, 1, 0};
  std::uint8_t children = 3;                ///< that all rays together may have
  std::uint8_t credits_each = 1;            ///< packets of rays, for each (sender, target)
  std::uint8_t rays_a_packet = 1;           ///< more than 1 only with one credit
  std::uint8_t return_batch = 1;            ///< credits that a busy node collects
  std::uint8_t queue_packets = 0;           ///< at most 2
  std::uint8_t shared_slots = 0;            ///< at each owner, on request; 0: nodes have credits_each of their own
  std::uint8_t open_packets = model_nodes;  ///< being filled at one node at a time
  std::uint8_t asks_max = model_nodes;      ///< owners that a node may be asking for a place
  bool has_backpressure = true;
  std::uint8_t owners = model_nodes;  ///< children go to the first so many nodes: fewer, and more children can be explored
  // Rules that can be broken.
  bool counts_overflow = true;  ///< ray packets by way of the host count as ray packets
  bool host_returns_credit = true;
  bool token_waits_for_rest = true;  ///< a busy member keeps the token
  bool asks_again = true;            ///< asks owners that were not asked before, when another has answered
};

template <class Rules>
class ProtocolModel {
 public:
  enum class Kind : std::uint8_t { rays, overflow, credits, token, finish, ask, unused };

  struct Message {
    Kind kind{};
    std::uint8_t count = 0;   ///< rays or credits; for a token: whether it is black
    std::uint8_t owner = 0;   ///< for overflowed rays
    std::int8_t balance = 0;  ///< for a token
  };
  using Channel = ModelChannel<Message, 8>;
  /// Rays of the packets queued for one owner, in the order of closing.
  using Queue = std::array<std::uint8_t, 2>;
  struct Member {
    typename Rules::Termination termination;
    std::uint8_t primaries = 0;
    std::uint8_t children = 0;                         ///< children of the current hits, still to be made
    std::array<std::uint8_t, model_peers> backlog{};   ///< rays by sender; of the host: rays kept, by owner
    std::array<std::uint8_t, model_peers> owed{};      ///< credits to be given back, by sender
    std::array<std::uint8_t, model_peers> credits{};   ///< by target
    std::array<std::uint8_t, model_nodes> gathered{};  ///< rays by owner
    std::array<Queue, model_nodes> queue{};            ///< by owner
    std::uint8_t waiting = 0;                          ///< rays of the packet that has found neither credit nor room
    std::uint8_t waiting_owner = 0;
    std::array<std::uint8_t, model_nodes> asked{};       ///< whether a place is asked for, by owner
    std::array<std::uint8_t, model_nodes - 1> asking{};  ///< who waits for a place here, the longest first: index + 1
    std::uint8_t free_slots = 0;                         ///< shared ones
    std::uint8_t withheld = 0;                           ///< shared ones in which packets have arrived
    bool is_finished = false;
  };
  struct State {
    std::array<Member, model_peers> member;
    ModelChannels<Channel> channel{};
    std::uint8_t children_left = 0;
    std::uint8_t alive = 0;  ///< rays that have been made and have not ended
  };
  struct Action {
    const char* verb = "";
    std::uint8_t actor = 0;
    std::uint8_t other = 0;
    std::uint8_t count = 0;
    bool token = false;
    bool is_idle() const { return token; }
    std::string text() const {
      return peer_name(actor) + " " + verb + " (" + peer_name(other) + ", " + std::to_string(count) + ")";
    }
  };

  explicit ProtocolModel(const ProtocolSettings& settings) : settings_(settings) {}

  State initial() const {
    State state{.member{member(0), member(1), member(2), member(model_host)}, .children_left = settings_.children};
    for (const std::uint8_t primaries : settings_.primaries) {
      state.alive = static_cast<std::uint8_t>(state.alive + primaries);
    }
    return state;
  }

  /// Every byte that distinguishes two states.
  std::string key(const State& state) const {
    std::string bytes{static_cast<char>(state.children_left), static_cast<char>(state.alive)};
    for (const Member& m : state.member) {
      append(bytes, m);
    }
    append_messages(bytes, state.channel);
    return bytes;
  }

  template <class Visit>
  void for_each_step(const State& state, Visit visit) const {
    for (std::size_t to = 0; to < model_peers; ++to) {
      for (std::size_t from = 0; from < model_peers; ++from) {
        receive(state, from, to, visit);
      }
    }
    for (std::size_t node = 0; node < model_nodes; ++node) {
      work(state, node, visit);
    }
    host_work(state, visit);
  }

  /// What holds in every state.
  void check(const State& state) const {
    hold(rays_in(state) == state.alive, "no ray is lost and none appears");
    const Member& host = state.member[model_host];
    if (host.termination.is_terminated()) {
      hold(state.alive == 0, "termination is detected only when no ray is left");
      hold(ray_packets_in(state) == 0, "termination is detected only when no ray packet is under way");
      hold(asked_in(state) == 0, "termination is detected only when no place is asked for");
    }
    check_credits(state);
    if (settings_.shared_slots > 0) {
      check_shared_slots(state);
    }
  }

  /// Everything is done: proved, told to all, and every credit is where it started.
  bool is_end(const State& state) const {
    bool is_done = true;
    for (std::size_t node = 0; node < model_nodes; ++node) {
      is_done = is_done && state.member[node].is_finished;
    }
    for_each_message(state.channel, [&](const Message&) { is_done = false; });
    return is_done && state.alive == 0 && credits_are_home(state);
  }

  /// No ray is left, and nothing that counts as a packet of them.
  bool is_quiet(const State& state) const { return state.alive == 0 && ray_packets_in(state) == 0; }

 private:
  using Task = dataflow::Task;
  using Way = dataflow::Way;

  Member member(std::size_t peer) const {
    const bool is_host = peer == model_host;
    Member m{.termination = is_host ? Rules::Termination::initiator(model_tree)
                                    : Rules::Termination::member(nodes::NodeId{narrow(peer)}, model_tree)};
    m.primaries = is_host ? std::uint8_t{0} : settings_.primaries[peer];
    for (std::size_t target = 0; target < model_peers; ++target) {
      m.credits[target] = target == peer ? std::uint8_t{0} : target == model_host ? std::uint8_t{1} : credits_each(peer);
    }
    m.free_slots = is_host ? std::uint8_t{0} : settings_.shared_slots;
    return m;
  }

  /// That a peer has for a node without asking.
  std::uint8_t credits_each(std::size_t peer) const { return shares_with(peer) ? std::uint8_t{0} : settings_.credits_each; }
  /// Nodes' places are shared, the host's are its own.
  bool shares_with(std::size_t peer) const { return settings_.shared_slots > 0 && peer != model_host; }

  static void append(std::string& bytes, const Member& m) {
    const auto& token = m.termination.token();
    const bool flags[] = {m.termination.is_black(),
                          m.termination.holds_token(),
                          m.termination.is_called(),
                          m.termination.is_terminated(),
                          m.is_finished,
                          token.is_black != 0};
    char bits = 0;
    for (const bool flag : flags) {
      bits = static_cast<char>(bits * 2 + (flag ? 1 : 0));
    }
    bytes += {bits,
              static_cast<char>(m.termination.balance()),
              static_cast<char>(token.balance),
              static_cast<char>(m.termination.awaited()),
              static_cast<char>(m.primaries),
              static_cast<char>(m.children),
              static_cast<char>(m.waiting),
              static_cast<char>(m.waiting_owner),
              static_cast<char>(m.free_slots),
              static_cast<char>(m.withheld)};
    const auto add = [&](const auto& counts) {
      for (const std::uint8_t count : counts) {
        bytes += static_cast<char>(count);
      }
    };
    add(m.backlog);
    add(m.owed);
    add(m.credits);
    add(m.gathered);
    add(m.asked);
    add(m.asking);
    for (const Queue& queue : m.queue) {
      add(queue);
    }
  }

  bool credits_are_home(const State& state) const {
    bool is_home = true;
    for (std::size_t peer = 0; peer < model_peers; ++peer) {
      is_home = is_home && state.member[peer].credits == member(peer).credits &&
                state.member[peer].free_slots == member(peer).free_slots;
    }
    return is_home;
  }

  static std::uint32_t rays_in(const State& state) {
    std::uint32_t count = 0;
    for (const Member& m : state.member) {
      count += m.primaries + m.children + m.waiting;
      for (const std::uint8_t rays : m.backlog) {
        count += rays;
      }
      for (const std::uint8_t rays : m.gathered) {
        count += rays;
      }
      for (const Queue& queue : m.queue) {
        count += queue[0] + queue[1];
      }
    }
    for_each_message(state.channel, [&](const Message& message) { count += carries_rays(message) ? message.count : 0U; });
    return count;
  }

  static std::uint32_t ray_packets_in(const State& state) {
    std::uint32_t count = 0;
    for_each_message(state.channel,
                     [&](const Message& message) { count += carries_rays(message) || message.kind == Kind::unused ? 1U : 0U; });
    return count;
  }

  static std::uint32_t asked_in(const State& state) {
    std::uint32_t count = 0;
    for (const Member& m : state.member) {
      for (const std::uint8_t asked : m.asked) {
        count += asked;
      }
    }
    return count;
  }

  static bool carries_rays(const Message& message) { return message.kind == Kind::rays || message.kind == Kind::overflow; }

  /// A credit is with its sender, under way, or stands for a packet in the target's backlog: none is lost and none is made.
  void check_credits(const State& state) const {
    for (std::size_t from = 0; from < model_peers; ++from) {
      for (std::size_t to = 0; to < model_nodes; ++to) {
        if (from != to && !shares_with(from)) {
          const Member& target = state.member[to];
          const std::uint32_t rays = target.backlog[from], each = settings_.rays_a_packet;
          std::uint32_t count = state.member[from].credits[to] + target.owed[from] + (rays + each - 1) / each;
          count += count_in(state.channel[from][to], Kind::rays, false) + count_in(state.channel[to][from], Kind::credits, true);
          hold(rays <= settings_.credits_each * each, "a received ray has its place in the backlog");
          hold(count == settings_.credits_each || Rules::forwards(1, false), "no credit is lost and none is made");
        }
      }
    }
  }

  /// Checks a place that is shared, which may also be free or travel back unused; and of each pair there is one request,
  /// grant or place in use at most, for so many have room in the mailboxes.
  void check_shared_slots(const State& state) const {
    for (std::size_t to = 0; to < model_nodes; ++to) {
      const Member& target = state.member[to];
      hold(rays_of_nodes(target) <= settings_.shared_slots * settings_.rays_a_packet,
           "a received ray has its place in the backlog");
      std::uint32_t count = target.free_slots + target.withheld;
      for (std::size_t from = 0; from < model_nodes; ++from) {
        const Channel &there = state.channel[from][to], &back = state.channel[to][from];
        const std::uint32_t granted = count_in(back, Kind::credits, true) + state.member[from].credits[to];
        count += granted + count_in(there, Kind::rays, false) + count_in(there, Kind::unused, false);
        hold(count_in(there, Kind::ask, false) <= 1, "a request has its place in the mailbox");
        hold(granted <= 1, "a grant has its place in the mailbox");
      }
      hold(count == settings_.shared_slots, "no place is lost and none is made");
    }
  }

  static std::uint32_t rays_of_nodes(const Member& m) {
    std::uint32_t count = 0;
    for (std::size_t node = 0; node < model_nodes; ++node) {
      count += m.backlog[node];
    }
    return count;
  }

  static std::uint32_t count_in(const Channel& channel, Kind kind, bool by_count) {
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < channel.size; ++i) {
      if (channel.messages[i].kind == kind) {
        count += by_count ? channel.messages[i].count : 1U;
      }
    }
    return count;
  }

  static void send(State& state, std::size_t from, std::size_t to, const Message& message) {
    state.channel[from][to].add(message);
  }

  // ---- Receptions --------------------------------------------------------------------------------------------------------

  template <class Visit>
  void receive(const State& state, std::size_t from, std::size_t to, Visit visit) const {
    if (state.channel[from][to].size == 0) {
      return;
    }
    State next = state;
    const Message message = next.channel[from][to].take(0);
    accept(next, from, to, message);
    visit(Action{verb(message.kind), narrow(to), narrow(from), message.count, message.kind == Kind::token}, next);
  }

  static const char* verb(Kind kind) {
    constexpr std::array<const char*, 7> verbs{"receives rays",        "receives overflow", "receives credits",
                                               "receives the token",   "receives the end",  "is asked for a place",
                                               "is given back a place"};
    return verbs[static_cast<std::size_t>(kind)];
  }

  void accept(State& state, std::size_t from, std::size_t to, const Message& message) const {
    Member& m = state.member[to];
    switch (message.kind) {
      case Kind::rays:
        hold(!m.is_finished, "no ray comes after the end");
        m.termination.ray_packet_received();
        m.backlog[from] = static_cast<std::uint8_t>(m.backlog[from] + message.count);
        m.withheld = static_cast<std::uint8_t>(m.withheld + (shares_with(from) ? 1 : 0));
        break;
      case Kind::overflow:
        count_overflow(m, &Rules::Termination::ray_packet_received);
        m.backlog[message.owner] = static_cast<std::uint8_t>(m.backlog[message.owner] + message.count);
        if (settings_.host_returns_credit) {
          send(state, to, from, {.kind = Kind::credits, .count = 1});
        }
        break;
      case Kind::credits:
        m.credits[from] = static_cast<std::uint8_t>(m.credits[from] + message.count);
        if (is_shared(to, from)) {
          m.asked[from] = 0;
        }
        send_queued(state, to, from);
        ask_others(state, to, from);
        break;
      case Kind::ask:
        *std::find(m.asking.begin(), m.asking.end(), 0) = narrow(from + 1);
        grant_slots(state, to);
        break;
      case Kind::unused:
        m.termination.ray_packet_received();
        ++m.free_slots;
        grant_slots(state, to);
        break;
      case Kind::token:
        m.termination.take({.balance = message.balance, .is_black = message.count});
        break;
      case Kind::finish:
        m.is_finished = true;
        break;
    }
  }

  template <class Report>
  void count_overflow(Member& m, Report report) const {
    if (settings_.counts_overflow) {
      (m.termination.*report)();
    }
  }

  // ---- Shared places -----------------------------------------------------------------------------------------------------

  bool is_shared(std::size_t node, std::size_t owner) const { return shares_with(node) && owner != model_host; }

  void grant_slots(State& state, std::size_t owner) const {
    Member& m = state.member[owner];
    while (Rules::grants(m.free_slots, m.asking[0] > 0)) {
      send(state, owner, m.asking[0] - 1U, {.kind = Kind::credits, .count = 1});
      --m.free_slots;
      std::shift_left(m.asking.begin(), m.asking.end(), 1);
      m.asking.back() = 0;
    }
  }

  static bool has_rays(const Member& m, std::size_t owner) {
    return m.gathered[owner] > 0 || m.queue[owner][0] > 0 || (m.waiting > 0 && m.waiting_owner == owner);
  }

  /// After whatever changes the rays or the credits for `owner`.
  void ask_or_decline(State& state, std::size_t node, std::size_t owner) const {
    if (!is_shared(node, owner)) {
      return;
    }
    Member& m = state.member[node];
    if (Rules::declines(has_rays(m, owner), m.credits[owner] > 0)) {
      --m.credits[owner];
      m.termination.ray_packet_sent();
      send(state, node, owner, {.kind = Kind::unused});
    }
    ask(state, node, owner);
  }

  void ask(State& state, std::size_t node, std::size_t owner) const {
    Member& m = state.member[node];
    const auto asked = static_cast<std::uint32_t>(std::count(m.asked.begin(), m.asked.end(), 1));
    hold(asked <= settings_.asks_max, "a grant has its place in the mailbox");
    if (Rules::asks(has_rays(m, owner), m.credits[owner] > 0, m.asked[owner] > 0) && Rules::may_ask(asked, settings_.asks_max)) {
      m.asked[owner] = 1;
      send(state, node, owner, {.kind = Kind::ask});
    }
  }

  /// The owners behind the one that has answered, in their turns.
  void ask_others(State& state, std::size_t node, std::size_t answering) const {
    for (std::size_t i = 1; settings_.asks_again && is_shared(node, answering) && i < model_nodes; ++i) {
      if (const std::size_t owner = (answering + i) % model_nodes; owner != node) {
        ask(state, node, owner);
      }
    }
  }

  void free_slots(State& state, std::size_t node) const {
    Member& m = state.member[node];
    const std::uint32_t freed = dataflow::slots_freed(m.withheld, rays_of_nodes(m), settings_.rays_a_packet);
    m.withheld = static_cast<std::uint8_t>(m.withheld - freed);
    m.free_slots = static_cast<std::uint8_t>(m.free_slots + freed);
    grant_slots(state, node);
  }

  // ---- A node's quantum --------------------------------------------------------------------------------------------------

  static std::uint32_t queued_in(const Member& m) {
    std::uint32_t count = 0;
    for (const Queue& queue : m.queue) {
      count += (queue[0] > 0 ? 1U : 0U) + (queue[1] > 0 ? 1U : 0U);
    }
    return count;
  }

  static bool may_leave(const Member& m, std::size_t owner) { return m.gathered[owner] > 0 && m.credits[owner] > 0; }

  dataflow::NodeState state_of(const Member& m) const {
    const auto any = [](const auto& counts) {
      return std::any_of(counts.begin(), counts.end(), [](std::uint8_t count) { return count > 0; });
    };
    return {.packet_waits = m.waiting > 0,
            .is_tracing = m.children > 0,
            .has_backlog = any(m.backlog),
            .has_primaries = m.primaries > 0,
            .admits_primaries = !settings_.has_backpressure || Rules::admits_primaries(queued_in(m), settings_.queue_packets),
            .can_flush = may_leave(m, 0) || may_leave(m, 1) || may_leave(m, 2),
            .has_gathered = any(m.gathered) || queued_in(m) > 0,
            .is_unanswered = any(m.asked)};
  }

  template <class Visit>
  void work(const State& state, std::size_t node, Visit visit) const {
    const dataflow::NodeState what = state_of(state.member[node]);
    const Task task = Rules::next_task(what);
    if (Rules::is_passive(what) || !settings_.token_waits_for_rest) {
      hand_on(state, node, visit);
    }
    switch (task) {
      case Task::send_waiting:
        return send_waiting(state, node, visit);
      case Task::go_on:
        return make_child(state, node, visit);
      case Task::take_received:
        return take_received(state, node, visit);
      case Task::start_primary:
        return start_primary(state, node, visit);
      case Task::flush:
        return flush(state, node, visit);
      case Task::rest:
        return rest(state, node, visit);
    }
  }

  template <class Visit>
  void send_waiting(State state, std::size_t node, Visit visit) const {
    Member& m = state.member[node];
    const std::size_t owner = m.waiting_owner;
    const bool has_room = queued_in(m) < settings_.queue_packets;
    const Way way = Rules::way_of(m.credits[owner] > 0, has_room, m.credits[model_host] > 0);
    if (way == Way::wait) {
      return;
    }
    const std::uint8_t count = std::exchange(m.waiting, std::uint8_t{0});
    m.waiting_owner = 0;
    if (way == Way::to_queue) {
      Queue& queue = m.queue[owner];
      queue[queue[0] > 0 ? 1 : 0] = count;
      ask_or_decline(state, node, owner);
      return visit(Action{"queues rays", narrow(node), narrow(owner), count}, state);
    }
    const std::size_t target = way == Way::to_owner ? owner : model_host;
    send_rays(state, node, target, {target == owner ? Kind::rays : Kind::overflow, count, narrow(owner)});
    ask_or_decline(state, node, owner);
    visit(Action{"sends rays", narrow(node), narrow(target), count}, state);
  }

  void send_queued(State& state, std::size_t node, std::size_t owner) const {
    if (node == model_host || owner == model_host) {
      return;
    }
    Queue& queue = state.member[node].queue[owner];
    while (queue[0] > 0 && state.member[node].credits[owner] > 0) {
      send_rays(state, node, owner, {Kind::rays, queue[0]});
      queue = {queue[1], 0};
    }
    ask_or_decline(state, node, owner);
  }

  void send_rays(State& state, std::size_t from, std::size_t to, const Message& message) const {
    Member& m = state.member[from];
    m.credits[to] = static_cast<std::uint8_t>(m.credits[to] - 1);
    if (message.kind == Kind::overflow) {
      count_overflow(m, &Rules::Termination::ray_packet_sent);
    } else {
      m.termination.ray_packet_sent();
    }
    send(state, from, to, {message.kind, message.count, message.kind == Kind::overflow ? message.owner : std::uint8_t{0}});
  }

  /// A child goes to another node: one that stays is what the next child may be.
  template <class Visit>
  void make_child(const State& state, std::size_t node, Visit visit) const {
    for (std::size_t owner = 0; owner < settings_.owners; ++owner) {
      if (owner != node) {
        State next = state;
        Member& m = next.member[node];
        --m.children;
        hold(m.gathered[owner] > 0 || open_in(m) < settings_.open_packets, "a new ray finds a packet to be put into");
        hold(m.gathered[owner] < settings_.rays_a_packet, "a new ray finds room in its gather");
        if (++m.gathered[owner] == settings_.rays_a_packet) {
          close(m, owner);
        } else if (Rules::must_close(open_in(m), settings_.open_packets)) {
          close(m, fullest(m));
        }
        ask_or_decline(next, node, owner);
        visit(Action{"makes a child", narrow(node), narrow(owner), 1}, next);
      }
    }
  }

  static std::uint32_t open_in(const Member& m) {
    return static_cast<std::uint32_t>(m.gathered.size()) -
           static_cast<std::uint32_t>(std::count(m.gathered.begin(), m.gathered.end(), 0));
  }
  static std::size_t fullest(const Member& m) {
    return static_cast<std::size_t>(std::max_element(m.gathered.begin(), m.gathered.end()) - m.gathered.begin());
  }

  /// The rays gathered for `owner` become a packet, which waits until it is sent.
  static void close(Member& m, std::size_t owner) {
    hold(m.waiting == 0, "one packet at most waits");
    m.waiting = m.gathered[owner];
    m.waiting_owner = narrow(owner);
    m.gathered[owner] = 0;
  }

  template <class Visit>
  void take_received(const State& state, std::size_t node, Visit visit) const {
    for (std::size_t sender = 0; sender < model_peers; ++sender) {
      if (state.member[node].backlog[sender] > 0) {
        State next = state;
        Member& m = next.member[node];
        --m.backlog[sender];
        if (shares_with(sender)) {
          free_slots(next, node);
          trace(next, {"traces a received ray", narrow(node), narrow(sender)}, visit);
          continue;
        }
        // With one credit a packet is used up when no ray of its sender is left; with several a packet has one ray.
        const bool is_used_up = settings_.rays_a_packet == 1 || m.backlog[sender] == 0;
        m.owed[sender] = static_cast<std::uint8_t>(m.owed[sender] + (is_used_up ? 1 : 0));
        return_credits(next, node, sender, false);
        trace(next, {"traces a received ray", narrow(node), narrow(sender)}, visit);
      }
    }
  }

  template <class Visit>
  void start_primary(State state, std::size_t node, Visit visit) const {
    --state.member[node].primaries;
    trace(state, {"traces a primary ray", narrow(node), narrow(node)}, visit);
  }

  /// A traced ray ends and has no, one or two children, as far as the bound allows.
  template <class Visit>
  void trace(const State& state, Action action, Visit visit) const {
    for (std::uint8_t children = 0; children <= 2 && children <= state.children_left; ++children) {
      State next = state;
      Member& m = next.member[action.actor];
      m.children = static_cast<std::uint8_t>(m.children + children);
      next.children_left = static_cast<std::uint8_t>(next.children_left - children);
      next.alive = static_cast<std::uint8_t>(next.alive + children - 1);
      action.count = children;
      visit(action, next);
    }
  }

  template <class Visit>
  void flush(const State& state, std::size_t node, Visit visit) const {
    for (std::size_t owner = 0; owner < model_nodes; ++owner) {
      if (may_leave(state.member[node], owner)) {
        State next = state;
        close(next.member[node], owner);
        visit(Action{"flushes a packet", narrow(node), narrow(owner)}, next);
      }
    }
  }

  template <class Visit>
  void rest(const State& state, std::size_t node, Visit visit) const {
    for (std::size_t sender = 0; sender < model_peers; ++sender) {
      State next = state;
      if (return_credits(next, node, sender, true)) {
        visit(Action{"returns credits", narrow(node), narrow(sender)}, next);
      }
    }
  }

  bool return_credits(State& state, std::size_t node, std::size_t sender, bool rests) const {
    Member& m = state.member[node];
    if (!Rules::returns_credits(m.owed[sender], settings_.return_batch, rests)) {
      return false;
    }
    send(state, node, sender, {.kind = Kind::credits, .count = m.owed[sender]});
    m.owed[sender] = 0;
    return true;
  }

  template <class Visit>
  void hand_on(const State& state, std::size_t peer, Visit visit) const {
    hand_on_token(
        state, peer,
        [&](State& next, std::size_t target, const dataflow::Token& token) {
          send(next, peer, target, {Kind::token, narrow(token.is_black), 0, static_cast<std::int8_t>(token.balance)});
        },
        [&](const State& next, bool is_idle) {
          visit(Action{"hands on the token", narrow(peer), narrow(peer), 0, is_idle}, next);
        });
  }

  // ---- The host's quantum ------------------------------------------------------------------------------------------------

  template <class Visit>
  void host_work(const State& state, Visit visit) const {
    const Member& host = state.member[model_host];
    if (host.is_finished) {
      return;
    }
    if (host.termination.is_terminated()) {
      return finish(state, visit);
    }
    std::uint64_t kept = 0;
    for (std::size_t owner = 0; owner < model_nodes; ++owner) {
      kept += host.backlog[owner];
      if (Rules::forwards(host.backlog[owner], host.credits[owner] > 0)) {
        forward(state, owner, visit);
      }
    }
    if (Rules::host_is_passive(kept) || !settings_.token_waits_for_rest) {
      hand_on(state, model_host, visit);
    }
  }

  template <class Visit>
  void forward(State state, std::size_t owner, Visit visit) const {
    Member& host = state.member[model_host];
    const std::uint8_t count = std::min(host.backlog[owner], settings_.rays_a_packet);
    host.backlog[owner] = static_cast<std::uint8_t>(host.backlog[owner] - count);
    host.credits[owner] = std::max(host.credits[owner], std::uint8_t{1});  // a host that does not wait for it makes one up
    send_rays(state, model_host, owner, {Kind::rays, count});
    visit(Action{"forwards rays", narrow(model_host), narrow(owner), count}, state);
  }

  template <class Visit>
  void finish(State state, Visit visit) const {
    for (std::size_t node = 0; node < model_nodes; ++node) {
      send(state, model_host, node, {.kind = Kind::finish});
    }
    state.member[model_host].is_finished = true;
    visit(Action{"tells the end", narrow(model_host), narrow(model_host)}, state);
  }

  ProtocolSettings settings_;
};

}  // namespace dmpc::tests
