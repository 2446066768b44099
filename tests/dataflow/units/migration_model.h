// Nodes that hand one unit of space to each other while rays are under way to it, in every order of events: the questions, pages,
// primary rays and acknowledgements of dataflow/units/migration.h with the proof of the end of dataflow/termination.h. Flow
// control is left out: it has its own model, and what is migrated has places of its own.
//
// Rays of other units have come to every node before, so each may ask. Whether a node finds another worth asking is left open: it
// may after every packet that counts. Packets overtake each other, as they do under chaos.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "dataflow/termination.h"
#include "dataflow/units/migration.h"
#include "tests/dataflow/peers_model.h"

namespace dmpc::tests {

/// The rules as they are; each can be broken.
struct MigrationRules {
  bool sends_on = true;              ///< a ray that comes to a former owner goes on to the one it knows
  bool counts_transfers = true;      ///< for the proof of the end, as packets of rays
  bool counts_primaries = true;      ///< including those that go along with a unit
  bool gives_primaries_away = true;  ///< who hands them over starts none of them
  bool active_until_content = true;  ///< a node that is about to ask keeps the token
  bool news_wakes = false;           ///< a node that hears who has the unit may ask
  bool answers_from_last_page = true;
  bool stores_before_acknowledging = true;
  bool keeps_pages = true;     ///< a donor, for rays that walk there
  bool donor_migrates = true;  ///< with the last acknowledgement it no longer answers
  bool asks_once = true;       ///< for all rays received, whatever the answer
  bool refuses_while_moving = true;
  bool believes_old_news = false;
};

struct MigrationSettings {
  std::array<std::uint8_t, model_nodes> rays{1, 1, 1};  ///< that start on a node, all of them for the unit
  /// That start later, or go along with the unit: until then the node may ask, but is not passive.
  std::array<std::uint8_t, model_nodes> held{};
  std::uint8_t questions = 2;  ///< that all nodes together may ask
  MigrationRules rules = {};
};

class MigrationModel {
 public:
  enum class Kind : std::uint8_t { ray, ask, refusal, page, primaries, acknowledgement, moved, token };
  struct Message {
    Kind kind{};
    std::uint8_t version = 0;  ///< for news and pages; for a token: whether it is black
    std::uint8_t owner = 0;    ///< for news; for a page: whether it is the last
    std::int8_t balance = 0;   ///< for a token; for primary rays: how many
  };
  using Channel = ModelChannel<Message, 6>;
  struct Member {
    dataflow::Migration migration;
    dataflow::Termination termination = dataflow::Termination::initiator(model_tree);
    std::uint8_t owner = 0, version = 0;  ///< the unit's, as known here
    std::uint8_t rays = 0;                ///< not looked at yet
    std::uint8_t held = 0;                ///< not started
    std::uint8_t walking = 0;             ///< rays taken up while the node answered for the unit
    std::uint8_t recipient = 0;           ///< for the unit that is being given
    std::uint8_t parts_left = 0;          ///< parts of that unit: its last page, its primary rays
    std::uint8_t unstored = 0;            ///< a last page that a broken node has acknowledged: its version
    bool has_pages = false;
    bool wants = false;  ///< finds another worth asking
  };
  struct State {
    std::array<Member, model_peers> member;
    ModelChannels<Channel> channel{};
    std::uint8_t alive = 0, questions_left = 0;
  };
  struct Action {
    const char* verb = "";
    std::uint8_t actor = 0;
    bool token = false;
    bool is_idle() const { return token; }
    std::string text() const { return peer_name(actor) + " " + verb; }
  };

  explicit MigrationModel(const MigrationSettings& settings) : settings_(settings) {}

  State initial() const {
    State state;
    state.questions_left = settings_.questions;
    for (std::size_t node = 0; node < model_nodes; ++node) {
      Member& m = state.member[node];
      m.termination = dataflow::Termination::member(nodes::NodeId{narrow(node)}, model_tree);
      m.rays = settings_.rays[node];
      m.held = settings_.held[node];
      state.alive = narrow(state.alive + m.rays + m.held);
      m.migration.rays_came();
      m.wants = true;
    }
    state.member[0].has_pages = true;
    return state;
  }

  /// Every byte that distinguishes two states.
  std::string key(const State& state) const {
    std::string bytes{static_cast<char>(state.alive), static_cast<char>(state.questions_left)};
    for (const Member& m : state.member) {
      append(bytes, m);
    }
    append_messages(bytes, state.channel);
    return bytes;
  }

  template <class Visit>
  void for_each_step(const State& state, Visit visit) const {
    for (std::size_t from = 0; from < model_peers; ++from) {
      for (std::size_t to = 0; to < model_peers; ++to) {
        for (std::size_t i = 0; i < state.channel[from][to].size; ++i) {  // in any order
          State next = state;
          const Message message = next.channel[from][to].take(i);
          receive(next, from, to, message);
          visit(Action{verb(message.kind), narrow(to), message.kind == Kind::token}, next);
        }
      }
    }
    for (std::size_t node = 0; node < model_nodes; ++node) {
      work(state, node, visit);
    }
    if (!state.member[model_host].termination.is_terminated()) {
      hand_on(state, model_host, visit);
    }
  }

  /// What holds in every state.
  void check(const State& state) const {
    std::uint32_t rays = 0, answering = 0, given = 0, taken = 0, wanting = 0;
    for (std::size_t node = 0; node < model_nodes; ++node) {
      const Member& m = state.member[node];
      rays += m.rays + m.held + m.walking;
      answering += m.owner == node ? 1 : 0;
      given += static_cast<std::uint32_t>(m.migration.given_count());
      taken += static_cast<std::uint32_t>(m.migration.taken_count());
      wanting += wants_to_ask(state, node) ? 1 : 0;
    }
    hold(rays + rays_under_way(state) == state.alive, "no ray is lost or doubled while a unit moves");
    hold(answering >= 1, "somebody answers for the unit");
    if (state.member[model_host].termination.is_terminated()) {
      hold(state.alive == 0, "termination is detected only when no ray is left");
      hold(count_of(state, is_counted) == 0 && given == taken, "termination is detected only when no unit is under way");
      hold(wanting == 0, "termination is detected only when nobody will ask");
      hold(answering == 1, "in the end one node answers for the unit");
    }
  }

  /// The end is proved, and nothing is under way.
  bool is_end(const State& state) const {
    return state.member[model_host].termination.is_terminated() && count_of(state, [](Kind) { return true; }) == 0;
  }
  bool is_quiet(const State& state) const {
    return state.alive == 0 && count_of(state, is_counted) == 0 && !is_anybody_active(state);
  }

 private:
  static const char* verb(Kind kind) {
    constexpr std::array<const char*, 8> verbs{"receives a ray",         "is asked for the unit", "is refused",
                                               "receives a page",        "receives primary rays", "hears that it came",
                                               "hears who has the unit", "receives the token"};
    return verbs[static_cast<std::size_t>(kind)];
  }
  static bool is_counted(Kind kind) { return kind != Kind::moved && kind != Kind::token; }
  bool counts(Kind kind) const {
    return kind == Kind::ray ||
           (kind == Kind::primaries ? settings_.rules.counts_primaries : settings_.rules.counts_transfers && is_counted(kind));
  }

  static void append(std::string& bytes, const Member& m) {
    const auto& token = m.termination.token();
    for (const int value : {int{m.migration.may_ask()},
                            int{m.migration.is_settled()},
                            int(m.migration.given_count()),
                            int(m.migration.taken_count()),
                            int(m.termination.balance()),
                            int{m.termination.is_black()},
                            int{m.termination.holds_token()},
                            int{m.termination.is_called()},
                            int(m.termination.awaited()),
                            int{m.termination.is_terminated()},
                            int(token.balance),
                            int(token.is_black),
                            int{m.owner},
                            int{m.version},
                            int{m.rays},
                            int{m.held},
                            int{m.walking},
                            int{m.recipient},
                            int{m.parts_left},
                            int{m.unstored},
                            int{m.has_pages},
                            int{m.wants},
                            int{m.migration.may_give()},
                            int{m.migration.have_rays_come()}}) {
      bytes += static_cast<char>(value);
    }
  }

  template <class Of>
  std::uint32_t count_of(const State& state, Of of) const {
    std::uint32_t count = 0;
    for_each_message(state.channel, [&](const Message& message) { count += of(message.kind) ? 1 : 0; });
    return count;
  }
  std::uint32_t rays_under_way(const State& state) const {
    std::uint32_t rays = 0;
    for_each_message(state.channel, [&](const Message& message) {
      rays += message.kind == Kind::ray ? 1U : 0U;
      rays += message.kind == Kind::primaries ? static_cast<std::uint32_t>(message.balance) : 0U;
    });
    return rays;
  }
  bool is_anybody_active(const State& state) const {
    bool is_active = false;
    for (std::size_t node = 0; node < model_nodes; ++node) {
      is_active = is_active || wants_to_ask(state, node);
    }
    return is_active;
  }

  void send(State& state, std::size_t from, std::size_t to, const Message& message) const {
    if (counts(message.kind)) {
      state.member[from].termination.ray_packet_sent();
    }
    state.channel[from][to].add(message);
  }

  static bool wants_to_ask(const State& state, std::size_t node) {
    const Member& m = state.member[node];
    return m.migration.may_ask() && m.wants && state.questions_left > 0 && m.owner != node;
  }
  static bool has_work(const Member& m) { return m.rays + m.walking > 0 || m.unstored > 0; }

  template <class Visit>
  void work(const State& state, std::size_t node, Visit visit) const {
    const Member& now = state.member[node];
    if (now.unstored > 0) {
      State next = state;
      own(next.member[node], node, now.unstored);
      next.member[node].unstored = 0;
      visit(Action{"stores a page", narrow(node)}, next);
    }
    if (now.walking > 0) {
      hold(now.has_pages, "a ray is traced where the unit's pages are");
      State next = state;
      --next.member[node].walking;
      --next.alive;
      visit(Action{"traces a ray", narrow(node)}, next);
    }
    if (now.held > 0) {
      State next = state;
      --next.member[node].held;
      ++next.member[node].rays;
      visit(Action{"starts a ray", narrow(node)}, next);
    }
    if (now.rays > 0) {
      look_at_ray(state, node, visit);
    }
    if (!has_work(now)) {
      rest(state, node, visit);
    }
  }

  template <class Visit>
  void look_at_ray(const State& state, std::size_t node, Visit visit) const {
    State next = state;
    Member& m = next.member[node];
    --m.rays;
    if (m.owner == node) {
      ++m.walking;
      return visit(Action{"takes up a ray", narrow(node)}, next);
    }
    if (settings_.rules.sends_on) {
      send(next, node, m.owner, {.kind = Kind::ray});
    }
    visit(Action{"sends a ray on", narrow(node)}, next);
  }

  template <class Visit>
  void rest(const State& state, std::size_t node, Visit visit) const {
    const bool wants = wants_to_ask(state, node);
    if (wants) {
      for (std::size_t other = 0; other < model_nodes; ++other) {
        if (other != node) {
          State next = state;
          ask(next, node, other);
          visit(Action{"asks for the unit", narrow(node)}, next);
        }
      }
      State next = state;
      next.member[node].wants = false;
      visit(Action{"finds nobody worth asking", narrow(node)}, next);
    }
    if (state.member[node].held == 0 && (!wants || !settings_.rules.active_until_content)) {
      hand_on(state, node, visit);
    }
  }

  void ask(State& state, std::size_t node, std::size_t other) const {
    Member& m = state.member[node];
    m.migration.ask();
    m.wants = false;
    --state.questions_left;
    send(state, node, other, {.kind = Kind::ask});
  }

  template <class Visit>
  void hand_on(const State& state, std::size_t peer, Visit visit) const {
    hand_on_token(
        state, peer,
        [&](State& next, std::size_t target, const dataflow::Token& token) {
          send(next, peer, target, {Kind::token, narrow(token.is_black), 0, static_cast<std::int8_t>(token.balance)});
        },
        [&](const State& next, bool is_idle) {
          visit(Action{"hands on the token", narrow(peer), is_idle}, next);
        });
  }

  static void own(Member& m, std::size_t node, std::uint8_t version) {
    m.owner = narrow(node);
    m.version = version;
    m.has_pages = true;
  }

  void receive(State& state, std::size_t from, std::size_t to, const Message& message) const {
    Member& m = state.member[to];
    if (counts(message.kind)) {
      m.termination.ray_packet_received();
    }
    m.wants = m.wants || is_counted(message.kind) || (settings_.rules.news_wakes && message.kind == Kind::moved);
    switch (message.kind) {
      case Kind::ray:
        m.migration.rays_came();
        ++m.rays;
        if (m.owner != to) {
          send(state, to, from, {Kind::moved, m.version, m.owner});
        }
        return;
      case Kind::ask:
        return receive_ask(state, from, to);
      case Kind::refusal:
        m.migration.refused();
        return settings_.rules.asks_once ? void() : ask_again(state, to);
      case Kind::page:
        return receive_page(state, from, to, message);
      case Kind::primaries:
        m.held = narrow(m.held + static_cast<std::size_t>(message.balance));
        m.migration.taken();
        m.migration.rays_came();
        return send(state, to, from, {.kind = Kind::acknowledgement});
      case Kind::acknowledgement:
        return receive_acknowledgement(state, to);
      case Kind::moved:
        if (m.owner != to && (settings_.rules.believes_old_news || dataflow::is_news(m.version, message.version))) {
          m.owner = message.owner;
          m.version = message.version;
        }
        return;
      case Kind::token:
        return m.termination.take({.balance = message.balance, .is_black = message.version});
    }
  }

  void ask_again(State& state, std::size_t node) const {
    state.member[node].migration.rays_came();
    ++state.questions_left;
  }

  void receive_ask(State& state, std::size_t from, std::size_t to) const {
    Member& m = state.member[to];
    if ((settings_.rules.refuses_while_moving && !m.migration.may_give()) || m.owner != to) {
      return send(state, to, from, {.kind = Kind::refusal});
    }
    m.migration.give();
    m.recipient = narrow(from);
    m.parts_left = 2;
    send(state, to, from, {Kind::page, static_cast<std::uint8_t>(m.version + 1), 0});
  }

  /// The first of two, or the last.
  void receive_page(State& state, std::size_t from, std::size_t to, const Message& message) const {
    Member& m = state.member[to];
    const bool is_last = message.owner != 0;
    send(state, to, from, {.kind = Kind::acknowledgement});
    if (is_last && !settings_.rules.stores_before_acknowledging) {
      m.unstored = message.version;
    } else if (is_last) {
      own(m, to, message.version);
    } else if (!settings_.rules.answers_from_last_page) {
      m.owner = narrow(to);
    }
  }

  void receive_acknowledgement(State& state, std::size_t to) const {
    Member& m = state.member[to];
    switch (m.parts_left) {
      case 2:
        m.parts_left = 1;
        return send(state, to, m.recipient, {Kind::page, static_cast<std::uint8_t>(m.version + 1), 1});
      case 1:
        m.parts_left = 0;
        if (settings_.rules.donor_migrates) {
          m.owner = m.recipient;
          ++m.version;
        }
        send(state, to, m.recipient, {.kind = Kind::primaries, .balance = static_cast<std::int8_t>(m.held)});
        m.held = settings_.rules.gives_primaries_away ? 0 : m.held;
        return;
      default:
        m.has_pages = settings_.rules.keeps_pages;
        m.migration.given();
    }
  }

  MigrationSettings settings_;
};

}  // namespace dmpc::tests
