#include "nodes/ranks/ranks_runner.h"

#include <sched.h>

#include <algorithm>
#include <exception>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "nodes/processors.h"
#include "nodes/ranks/clock_drift.h"
#include "nodes/ranks/counting_waves.h"
#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/exchange.h"
#include "nodes/ranks/failure.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/nap.h"
#include "nodes/ranks/outbox.h"
#include "nodes/standstill.h"
#include "nodes/threads/clock.h"
#include "nodes/threads/node_threads.h"
#include "nodes/threads/promptness.h"

namespace dmpc::nodes {
namespace {

/// So many turns does a communicating thread that always has something to do take from one look at who is silent to the next.
constexpr std::uint32_t turns_a_look = 256;

std::vector<bool> here(std::size_t peer_count, const RankLinks& links) {
  const auto node_count = static_cast<std::uint32_t>(peer_count - 1);
  std::vector<bool> is_here;
  for (std::uint32_t index = 0; index <= node_count; ++index) {
    is_here.push_back(rank_of(index, node_count, links.rank_count()) == links.rank());
  }
  return is_here;
}

MailboxCapacity outbox_of(std::span<const NodeSpecification> specifications, const std::vector<bool>& is_here) {
  MailboxCapacity outbox = empty_outbox();
  for (std::size_t index = 0; index < specifications.size(); ++index) {
    if (!is_here[index]) {
      add_target(outbox, specifications[index].mailbox);
    }
  }
  return outbox;
}

MemoryPlan plan_of(const MailboxCapacity& outbox) {
  MemoryPlan plan;
  plan[Category::mailbox] = outbox.bytes();
  return plan;
}

std::size_t payload_bytes_max(std::span<const NodeSpecification> specifications) {
  std::size_t most = small_payload_bytes;
  for (const NodeSpecification& specification : specifications) {
    most = std::max(most, specification.mailbox.bulk_payload_bytes);
  }
  return most;
}

/// How the last word of a rank travels, behind its text.
struct Closing {
  Ending ending;
  FailureKind kind;
};

/// A rank's last word.
struct LastWord {
  Ending ending = Ending::none;
  FailureKind kind = FailureKind::internal;  ///< of one that has failed
  std::string text;                          ///< of one that has failed, or a line for each program of one that stalls
};

LastWord last_word_of(const NodeThreads& nodes) {
  LastWord word{.ending = nodes.ending()};
  if (word.ending == Ending::stalled) {
    word.text = nodes.describe();
  }
  if (nodes.failure()) {
    Failure failure = failure_of(nodes.failure());
    word.kind = failure.kind;
    word.text = std::move(failure.text);
  }
  return word;
}

}  // namespace

/// Thread safety: the nodes' threads touch `nodes` and, through it, the outbox; all else belongs to the communicating thread.
struct RanksRunner::Implementation {
  Implementation(std::span<const NodeSpecification> specifications, RankLinks& to, const std::optional<Chaos>& chaos,
                 Observer* observer)
      : links(to),
        disturbance(chaos),
        node_count(static_cast<std::uint32_t>(specifications.size() - 1)),
        is_here(here(specifications.size(), to)),
        outbox_capacity(outbox_of(specifications, is_here)),
        outbox_memory(plan_of(outbox_capacity)),
        outbox(outbox_capacity, outbox_memory),
        outlet{is_here, outbox},
        nodes(specifications, chaos, observer, &outlet),
        compares_clocks(observer != nullptr && to.rank() == 0),
        waves(to.rank_count()),
        last_words(to.rank_count()),
        reports(specifications.size()),
        rank_reports(to.rank_count()),
        nap(to.idle()) {
    core::expect(node_count >= to.rank_count(), "each rank has a node");
    core::expect(frame_bytes_for(payload_bytes_max(specifications)) <= to.frame_bytes(), "every packet fits a frame");
  }

  RunEnd run(std::stop_token stop) {
    core::expect(!is_run, "a runner runs once");
    is_run = true;
    const Promptness promptness;
    const std::stop_callback on_stop(std::move(stop), [this] { nodes.end(Ending::interrupted); });
    while (true) {
      try {
        start_with_others();
        communicate_until([this] { return is_closed(); });
        close_account();
        const RunEnd end = judge();
        if (compares_clocks && end == RunEnd::finished) {
          read_clocks_again();
        }
        return end;
      } catch (const LostRank&) {
        nodes.fail(std::current_exception());
        nodes.join();
        throw;
      } catch (const Dismissed&) {  // while it waited for the start
        throw;
      } catch (...) {
        if (is_closed()) {
          throw;
        }
        nodes.fail(std::current_exception());  // of which the others are to hear
      }
    }
  }

  /// Until all ranks have made their nodes nobody starts: packets would come where there is no mailbox yet. Rank 0 knows when.
  void start_with_others() {
    if (std::exchange(has_started, true)) {
      return;
    }
    if (links.rank() == 0) {
      if (compares_clocks) {
        clocks_before = read_clocks();
      }
      start_ns = nanoseconds(CLOCK_MONOTONIC);
      for (std::uint32_t rank = 1; rank < links.rank_count(); ++rank) {
        const auto offset_ns = static_cast<std::uint64_t>(compares_clocks ? clocks_before[rank].offset_ns() : 0);
        links.say(rank, Item::start, bytes_of(start_ns + offset_ns));
      }
    } else {
      Exchange(links).turn_until([this] { return may_start || has_failed(); }, [this](auto&&... item) { receive(item...); });
      start_ns = std::min(start_ns, nanoseconds(CLOCK_MONOTONIC));  // as far as the clocks go wrong, it may be to come
    }
    nodes.start(start_ns);
  }

  /// Here or, as is said, elsewhere: what others wait for before the start may never come.
  bool has_failed() const { return nodes.ending() == Ending::failed; }

  /// Reads each other rank's clock, in the shortest of several round trips. They answer while they wait for the start, or for
  /// clocks_read.
  std::vector<ClockAnswer> read_clocks() {
    std::vector<ClockAnswer> shortest(links.rank_count());
    for (std::uint32_t rank = 1; rank < links.rank_count(); ++rank) {
      for (int question = 0; question < clock_questions; ++question) {
        const ClockAnswer next = ask_clock(rank);
        if (question == 0 || next.round_trip_ns() < shortest[rank].round_trip_ns()) {
          shortest[rank] = next;
        }
      }
    }
    return shortest;
  }

  /// Nothing of use once a rank has failed, which may never answer.
  ClockAnswer ask_clock(std::uint32_t rank) {
    heard.reset();
    const std::uint64_t asked_ns = nanoseconds(CLOCK_MONOTONIC);
    links.say(rank, Item::clock_asked, {});
    Exchange(links).turn_until([this] { return heard || has_failed(); }, [this](auto&&... item) { receive(item...); });
    ClockAnswer answer = heard.value_or(ClockAnswer{});
    answer.asked_ns = asked_ns;
    return answer;
  }

  void read_clocks_again() {
    if (links.rank() == 0) {
      clocks_after = read_clocks();
      links.say_to_all(Item::clocks_read, {});
    }
    communicate_until([this] { return links.rank() == 0 ? links.has_said_all() : are_clocks_read; });
  }

  template <class IsDone>
  void communicate_until(const IsDone& is_done) {
    for (std::uint32_t turn = 0; !is_done(); ++turn) {
      bool has_moved = links.take([this](auto&&... item) { receive(item...); });
      if (nodes.ending() == Ending::none) {
        has_moved = send_packets() || has_moved;
        count_if_quiet();
      } else if (!is_closing) {
        close();
      }
      has_moved = links.flush() || has_moved;
      if (!has_moved || turn % turns_a_look == 0) {
        links.look_after();
      }
      has_moved ? nap.end() : rest();
    }
  }

  void receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
    LastWord& word = last_words[rank];
    const auto append = [&bytes](std::string& text) { text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size()); };
    switch (header.item) {
      case Item::packet:
        ++traffic.packets_received;
        return is_closing ? void() : NodeThreads::Bringing(nodes).bring(NodeId{header.target}, header.packet, bytes);
      case Item::counts:
        return waves.count(rank, value_of<Counts>(bytes));
      case Item::text:
        return append(word.text);
      case Item::closing:
        word.ending = value_of<Closing>(bytes).ending;
        word.kind = value_of<Closing>(bytes).kind;
        return nodes.end(word.ending);
      case Item::report:
        return append(reports.at(header.target));
      case Item::reported:
        ++ranks_reported;
        return;
      case Item::rank_traffic:
        rank_reports[rank].traffic = value_of<RankTraffic>(bytes);
        return;
      case Item::rank_report:
        return append(rank_reports[rank].told);
      case Item::rank_reported:
        ++ranks_told;
        return;
      case Item::clock_asked:
        compares_clocks = true;  // before the start, hence after the run, too
        return links.say(rank, Item::clock_told, bytes_of(nanoseconds(CLOCK_MONOTONIC)));
      case Item::clock_told:
        heard = {.told_ns = value_of<std::uint64_t>(bytes), .heard_ns = nanoseconds(CLOCK_MONOTONIC)};
        return;
      case Item::clocks_read:
        are_clocks_read = true;
        return;
      case Item::start:
        start_ns = value_of<std::uint64_t>(bytes);
        may_start = true;
        return;
      case Item::failure:
        if (word.ending == Ending::failed || word.ending == Ending::stalled) {
          return;  // of the run, of which this rank knows
        }
        fail_as_said(links.name_of(rank), bytes);
      case Item::dismissal:
        throw Dismissed{value_of<int>(bytes)};
      case Item::stream:
      case Item::stream_read:
      case Item::ready:
        break;
    }
    core::expect(false, "what a run is made from comes before it");
  }

  /// Out of the outbox into frames, as far as there is room. A way that is full holds the others up, but not for long: what
  /// arrives at a rank has its place there, so frames are always taken.
  bool send_packets() {
    const std::uint64_t before = traffic.packets_sent;
    outbox.drain_while([this](const Packet& packet) {
      const auto target = value_of<TargetIndex>(packet.payload.first(sizeof(TargetIndex)));
      const std::span<const std::byte> payload = packet.payload.subspan(sizeof(TargetIndex));
      const ItemHeader header{.target = target,
                              .packet = {.bytes = static_cast<std::uint32_t>(payload.size()),
                                         .source = static_cast<std::uint16_t>(index_of(packet.source)),
                                         .kind = packet.kind}};
      const bool has_room = links.put(rank_of(target, node_count, links.rank_count()), header, payload);
      traffic.packets_sent += has_room ? 1 : 0;
      return has_room;
    });
    return traffic.packets_sent > before;
  }

  /// The order matters: nodes that sleep have put into the outbox what they had, and only what this thread brings wakes them.
  bool is_quiet() { return nodes.all_sleep() && outbox.is_drained(); }

  void count_if_quiet() {
    if (!waves.has_counted(links.rank()) && is_quiet()) {
      const Counts counts{traffic.packets_sent, traffic.packets_received, nodes.unfinished_count()};
      waves.count(links.rank(), counts);
      links.say_to_all(Item::counts, bytes_of(counts));
    }
    if (const std::optional<Counts> still = waves.end_wave()) {
      nodes.end(still->unfinished == 0 ? Ending::finished : Ending::stalled);
    }
  }

  /// The last words of this rank, when its nodes have stopped: how the run has ended here and, if not well, what there is to say.
  void close() {
    is_closing = true;
    nodes.join();
    const LastWord word = last_word_of(nodes);
    if (!word.text.empty()) {
      links.say_to_all(Item::text, std::as_bytes(std::span(word.text)));
    }
    links.say_to_all(Item::closing, bytes_of(Closing{word.ending, word.kind}));
  }

  /// All have said their last word.
  bool is_closed() const {
    const auto is_silent = [](const LastWord& word) { return word.ending == Ending::none; };
    return is_closing && std::count_if(last_words.begin(), last_words.end(), is_silent) == 1 && links.has_said_all();
  }

  /// Every rank does so after the run, in which it is seen to that nothing else is under way.
  std::vector<std::string> gather(const Tell& tell) {
    std::vector<std::string> told = told_by(nodes.processors(), is_here.size(), tell);
    if (links.rank() == 0) {
      communicate_until([this] { return ranks_reported + 1 == links.rank_count(); });
      for (std::size_t index = 0; index < told.size(); ++index) {
        told[index] += reports[index];
      }
      return told;
    }
    for (std::uint32_t index = 0; index < told.size(); ++index) {
      if (!told[index].empty()) {
        links.say(0, Item::report, std::as_bytes(std::span(told[index])), index);
      }
    }
    links.say(0, Item::reported, {});
    communicate_until([this] { return links.has_said_all(); });
    return told;
  }

  /// A rank may be here while rank 0 still gathers from others what their nodes say: hence words of other kinds.
  std::vector<RankReport> gather_ranks(const std::string& told) {
    if (links.rank() == 0) {
      communicate_until([this] { return ranks_told + 1 == links.rank_count(); });
      rank_reports.front() = {traffic, {}, told};
      for (std::size_t rank = 1; rank < clocks_after.size(); ++rank) {
        rank_reports[rank].clock = ClockDrift(clocks_before[rank], clocks_after[rank], start_ns);
      }
      return std::move(rank_reports);
    }
    links.say(0, Item::rank_traffic, bytes_of(traffic));
    links.say(0, Item::rank_report, std::as_bytes(std::span(told)));
    links.say(0, Item::rank_reported, {});
    communicate_until([this] { return links.has_said_all(); });
    return {};
  }

  void close_account() {
    traffic.frames_sent = links.frames_sent();
    traffic.bytes_sent = links.bytes_sent();
    traffic.waves = waves.waves();
  }

  void rest() {
    const std::chrono::nanoseconds time = nap.next();
    if (time == time.zero()) {
      sched_yield();
    } else if (is_closing || !outbox.is_drained()) {  // what is in it waits for a frame to leave
      std::this_thread::sleep_for(time);
    } else if (outbox.fall_asleep()) {
      // Whoever has roused this thread before it slept has left something to be seen.
      const bool is_something_new = nodes.ending() != Ending::none || (nodes.all_sleep() && !waves.has_counted(links.rank()));
      outbox.wait(is_something_new ? time.zero() : time);
    }
  }

  RunEnd judge() const {
    const auto gravity = [](const LastWord& word) { return std::pair(word.ending, !word.text.empty()); };
    const auto gravest = std::max_element(last_words.begin(), last_words.end(),
                                          [&](const LastWord& a, const LastWord& b) { return gravity(a) < gravity(b); });
    switch (std::max(nodes.ending(), gravest->ending)) {  // as badly as anywhere
      case Ending::failed:
        if (nodes.failure()) {
          std::rethrow_exception(nodes.failure());
        }
        fail_as(gravest->kind, links.name_of(static_cast<std::uint32_t>(gravest - last_words.begin())) + ": " + gravest->text);
      case Ending::stalled:
        throw StandstillError(stall_text(disturbance) + nodes.describe() + texts());
      case Ending::interrupted:
        return RunEnd::interrupted;
      default:
        expect_nothing_lost();
        return RunEnd::finished;
    }
  }

  /// The texts of the other ranks.
  std::string texts() const {
    std::string texts;
    for (const LastWord& word : last_words) {
      texts += word.text;
    }
    return texts;
  }

  /// What was sent here or came here was received here or left.
  void expect_nothing_lost() const {
    nodes.expect_nothing_lies_about();
    std::uint64_t sent = 0, received = 0;
    for (const auto& processor : nodes.processors()) {
      sent += total(processor->node.counters().sent).packets;
      received += total(processor->node.counters().received).packets;
    }
    core::expect(sent + traffic.packets_received == received + traffic.packets_sent, "packets sent are packets received");
  }

  RankLinks& links;
  std::optional<Chaos> disturbance;
  std::uint32_t node_count;
  std::vector<bool> is_here;
  MailboxCapacity outbox_capacity;
  LocalMemory outbox_memory;
  Mailbox outbox;
  Outlet outlet;
  NodeThreads nodes;
  bool compares_clocks;
  CountingWaves waves;
  std::vector<LastWord> last_words;      ///< of other ranks, as far as they have come
  std::vector<std::string> reports;      ///< of other ranks' nodes, by node
  std::vector<RankReport> rank_reports;  ///< of other ranks themselves
  std::uint32_t ranks_reported = 0, ranks_told = 0;
  RankTraffic traffic;
  Nap nap;
  std::uint64_t start_ns = 0;                            ///< of the run, by this rank's clock
  std::vector<ClockAnswer> clocks_before, clocks_after;  ///< the run, by rank: what rank 0 knows of others' clocks
  std::optional<ClockAnswer> heard;                      ///< to the last question
  bool is_run = false, may_start = false, has_started = false, is_closing = false, are_clocks_read = false;
};

RanksRunner::RanksRunner(std::span<const NodeSpecification> specifications, RankLinks& links, const std::optional<Chaos>& chaos,
                         Observer* observer)
    : implementation_(std::make_unique<Implementation>(specifications, links, chaos, observer)) {}
RanksRunner::~RanksRunner() = default;

RunEnd RanksRunner::run(std::stop_token stop) { return implementation_->run(std::move(stop)); }

Node& RanksRunner::node(std::size_t index) { return implementation_->nodes.processor(index).node; }
Program& RanksRunner::program(std::size_t index) { return *implementation_->nodes.processor(index).program; }
bool RanksRunner::is_here(std::size_t index) const { return implementation_->nodes.is_here(index); }
std::vector<std::string> RanksRunner::gather(const Tell& tell) { return implementation_->gather(tell); }

std::vector<RankReport> RanksRunner::gather_ranks(const std::string& told) { return implementation_->gather_ranks(told); }
RankTraffic RanksRunner::traffic() const { return implementation_->traffic; }

}  // namespace dmpc::nodes
