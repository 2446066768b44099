#include "nodes/ranks/ranks_runner.h"

#include <sched.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/expect.h"
#include "nodes/ranks/counting_waves.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/nap.h"
#include "nodes/ranks/way.h"
#include "nodes/threads/node_threads.h"

namespace dmpc::nodes {
namespace {

using Clock = std::chrono::steady_clock;

/// Before a packet in the outbox.
using TargetIndex = std::uint32_t;
/// Frames that are taken before the outbox is looked at again.
constexpr int takes_at_once = 16;
/// Of a communicating thread that always has something to do, from one look at who is silent to the next.
constexpr std::uint32_t turns_a_look = 256;

std::vector<bool> here(std::size_t peer_count, const Fabric& fabric) {
  const auto node_count = static_cast<std::uint32_t>(peer_count - 1);
  std::vector<bool> is_here;
  for (std::uint32_t index = 0; index <= node_count; ++index) {
    is_here.push_back(rank_of(index, node_count, fabric.rank_count()) == fabric.rank());
  }
  return is_here;
}

/// A packet under way has a place in its target's mailbox. So what is under way to nodes elsewhere, all of which may wait here,
/// has as many as their mailboxes have together. Bytes are set aside when they are first written: of these places few ever are.
MailboxCapacity outbox_of(std::span<const NodeSpecification> specifications, const std::vector<bool>& is_here) {
  MailboxCapacity outbox{.small_front_bytes = sizeof(TargetIndex)};
  for (std::size_t index = 0; index < specifications.size(); ++index) {
    if (!is_here[index]) {
      const MailboxCapacity& mailbox = specifications[index].mailbox;
      outbox.small_slots += mailbox.small_slots;
      outbox.bulk_slots += mailbox.bulk_slots;
      outbox.bulk_payload_bytes = std::max(outbox.bulk_payload_bytes, mailbox.bulk_payload_bytes + sizeof(TargetIndex));
    }
  }
  return outbox;
}

MemoryPlan plan_of(const MailboxCapacity& outbox) {
  MemoryPlan plan;
  plan[Category::mailbox] = outbox.bytes();
  return plan;
}

std::size_t frame_bytes_of(std::span<const NodeSpecification> specifications) {
  std::size_t payload_bytes_max = small_payload_bytes;
  for (const NodeSpecification& specification : specifications) {
    payload_bytes_max = std::max(payload_bytes_max, specification.mailbox.bulk_payload_bytes);
  }
  return frame_bytes_for(payload_bytes_max);
}

/// What a failure is, for those who hear of it.
enum class FailureKind : std::uint8_t { internal, room, fabric };

/// How the last word of a rank travels, behind its text.
struct Closing {
  Ending ending;
  FailureKind kind;
};
/// Of a text, in one frame.
constexpr std::size_t text_bytes = frame_bytes_min / 2;

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
  try {
    if (nodes.failure()) {
      std::rethrow_exception(nodes.failure());
    }
  } catch (const core::RoomError& error) {
    word.kind = FailureKind::room;
    word.text = error.what();
  } catch (const FabricError& error) {
    word.kind = FailureKind::fabric;
    word.text = error.what();
  } catch (const std::exception& error) {
    word.text = error.what();
  } catch (...) {
    word.text = "something that is no error";
  }
  return word;
}

[[noreturn]] void fail_as(FailureKind kind, const std::string& text) {
  switch (kind) {
    case FailureKind::room:
      throw core::RoomError(text);
    case FailureKind::fabric:
      throw FabricError(text);
    case FailureKind::internal:
      break;
  }
  throw core::InternalError(text);
}

template <class T>
T value_of(std::span<const std::byte> bytes) {
  core::expect(bytes.size() == sizeof(T), "a word has the size of its kind");
  T value;
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

}  // namespace

/// Thread safety: the nodes' threads touch `nodes` and, through it, the outbox; all else belongs to the communicating thread.
struct RanksRunner::Implementation {
  Implementation(std::span<const NodeSpecification> specifications, Fabric& to, const std::optional<Chaos>& chaos,
                 Observer* observer, const RankSilence& silences)
      : fabric(to),
        silence(silences),
        disturbance(chaos),
        node_count(static_cast<std::uint32_t>(specifications.size() - 1)),
        is_here(here(specifications.size(), to)),
        outbox_capacity(outbox_of(specifications, is_here)),
        outbox_memory(plan_of(outbox_capacity)),
        outbox(outbox_capacity, outbox_memory),
        outlet{is_here, outbox},
        frame_bytes(frame_bytes_of(specifications)),
        nodes(specifications, chaos, observer, &outlet),
        waves(to.rank_count()),
        peers(to.rank_count()) {
    core::expect(node_count >= to.rank_count(), "each rank has a node");
    for (std::uint32_t rank = 0; rank < to.rank_count(); ++rank) {
      ways.emplace_back(to, rank);
    }
  }

  /// Another rank, as far as it is known here.
  struct Peer {
    FrameNumber frames_taken = 0;
    Clock::time_point heard, spoken_to;
    LastWord last_word;  ///< as far as it has come
  };

  RunEnd run(std::stop_token stop) {
    core::expect(!started, "a runner runs once");
    started = true;
    const std::stop_callback on_stop(std::move(stop), [this] { nodes.end(Ending::interrupted); });
    fabric.open(frame_bytes);
    const Clock::time_point now = Clock::now();
    for (Peer& peer : peers) {
      peer.heard = peer.spoken_to = now;
    }
    nodes.start();
    try {
      communicate();
    } catch (const FabricError&) {  // without a rank there is no orderly end
      nodes.fail(std::current_exception());
      nodes.join();
      throw;
    } catch (...) {
      nodes.fail(std::current_exception());
      communicate();
    }
    return judge();
  }

  void communicate() {
    for (std::uint32_t turn = 0; !is_closed(); ++turn) {
      bool has_moved = take_frames();
      if (nodes.ending() == Ending::none) {
        has_moved = send_packets() || has_moved;
        count_if_quiet();
      } else if (!is_closing) {
        close();
      }
      for (std::uint32_t rank = 0; rank < ways.size(); ++rank) {
        if (rank != fabric.rank() && ways[rank].flush()) {
          peers[rank].spoken_to = Clock::now();
          has_moved = true;
        }
      }
      if (!has_moved || turn % turns_a_look == 0) {
        look_after_ranks();
      }
      has_moved ? nap.end() : rest();
    }
  }

  bool take_frames() {
    int taken = 0;
    for (; taken < takes_at_once; ++taken) {
      const std::optional<Arrival> arrival = fabric.take();
      if (!arrival) {
        break;
      }
      receive(*arrival);
    }
    return taken > 0;
  }

  void receive(const Arrival& arrival) {
    Peer& peer = peers[arrival.rank];
    peer.heard = Clock::now();
    expect_number(peer.frames_taken, arrival);
    peer.frames_taken = number_of(arrival.frame) + 1;
    NodeThreads::Bringing bringing(nodes);
    for_each_item(arrival.frame, [&](const ItemHeader& header, std::span<const std::byte> bytes) {
      switch (header.item) {
        case Item::packet:
          ++traffic.packets_received;
          return is_closing ? void() : bringing.bring(NodeId{header.target}, header.packet, bytes);
        case Item::counts:
          return waves.count(arrival.rank, value_of<Counts>(bytes));
        case Item::text:
          peer.last_word.text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
          return;
        case Item::closing:
          peer.last_word.ending = value_of<Closing>(bytes).ending;
          peer.last_word.kind = value_of<Closing>(bytes).kind;
          return nodes.end(peer.last_word.ending);
      }
      core::expect(false, "an item is of a kind that there is");
    });
  }

  /// Whoever is left can still be told that a frame is lost.
  void expect_number(FrameNumber expected, const Arrival& arrival) {
    const FrameNumber number = number_of(arrival.frame);
    if (number != expected) {
      nodes.fail(std::make_exception_ptr(
          FabricError("a frame from " + fabric.name_of(arrival.rank) + " to " + fabric.name_of(fabric.rank()) +
                      " is lost: number " + std::to_string(number) + " came in place of number " + std::to_string(expected))));
    }
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
      const bool has_room = ways[rank_of(target, node_count, fabric.rank_count())].put(header, payload);
      traffic.packets_sent += has_room ? 1 : 0;
      return has_room;
    });
    return traffic.packets_sent > before;
  }

  /// The order matters: nodes that sleep have put into the outbox what they had, and only what this thread brings wakes them.
  bool is_quiet() { return nodes.all_sleep() && outbox.is_drained(); }

  void count_if_quiet() {
    if (!waves.has_counted(fabric.rank()) && is_quiet()) {
      const Counts counts{traffic.packets_sent, traffic.packets_received, nodes.unfinished_count()};
      waves.count(fabric.rank(), counts);
      say_to_all(Item::counts, bytes_of(counts));
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
    for (std::size_t offset = 0; offset < word.text.size(); offset += text_bytes) {
      const std::string part = word.text.substr(offset, text_bytes);
      say_to_all(Item::text, std::as_bytes(std::span(part)));
    }
    say_to_all(Item::closing, bytes_of(Closing{word.ending, word.kind}));
  }

  void say_to_all(Item item, std::span<const std::byte> bytes) {
    for (std::uint32_t rank = 0; rank < ways.size(); ++rank) {
      if (rank != fabric.rank()) {
        ways[rank].say(item, bytes);
      }
    }
  }

  /// All have said their last word.
  bool is_closed() const {
    if (!is_closing) {
      return false;
    }
    for (std::uint32_t rank = 0; rank < ways.size(); ++rank) {
      if (rank != fabric.rank() && (peers[rank].last_word.ending == Ending::none || !ways[rank].has_said_all())) {
        return false;
      }
    }
    return true;
  }

  void rest() {
    const std::chrono::nanoseconds time = nap.next();
    if (time == time.zero()) {
      sched_yield();
    } else if (is_closing || !outbox.is_drained()) {  // what is in it waits for a frame to leave
      std::this_thread::sleep_for(time);
    } else if (outbox.fall_asleep()) {
      // Whoever has roused this thread before it slept has left something to be seen.
      const bool is_something_new = nodes.ending() != Ending::none || (nodes.all_sleep() && !waves.has_counted(fabric.rank()));
      outbox.wait(is_something_new ? time.zero() : time);
    }
  }

  void look_after_ranks() {
    const Clock::time_point now = Clock::now();
    for (std::uint32_t rank = 0; rank < ways.size(); ++rank) {
      if (rank == fabric.rank()) {
        continue;
      }
      if (now - peers[rank].spoken_to > silence.life_sign) {
        ways[rank].show_life();
        peers[rank].spoken_to = now;
      }
      if (now - peers[rank].heard > silence.longest) {
        throw FabricError(fabric.name_of(rank) + " is lost: nothing has been heard of it for " +
                          std::to_string(silence.longest.count()) + " ms");
      }
    }
  }

  RunEnd judge() const {
    const auto gravity = [](const Peer& peer) { return std::pair(peer.last_word.ending, !peer.last_word.text.empty()); };
    const auto gravest =
        std::max_element(peers.begin(), peers.end(), [&](const Peer& a, const Peer& b) { return gravity(a) < gravity(b); });
    switch (std::max(nodes.ending(), gravest->last_word.ending)) {  // as badly as anywhere
      case Ending::failed:
        if (nodes.failure()) {
          std::rethrow_exception(nodes.failure());
        }
        fail_as(gravest->last_word.kind,
                fabric.name_of(static_cast<std::uint32_t>(gravest - peers.begin())) + ": " + gravest->last_word.text);
      case Ending::stalled:
        throw core::InternalError(stall_text(disturbance) + nodes.describe() + texts());
      case Ending::interrupted:
        return RunEnd::interrupted;
      default:
        expect_nothing_lost();
        return RunEnd::finished;
    }
  }

  /// Of the other ranks.
  std::string texts() const {
    std::string texts;
    for (const Peer& peer : peers) {
      texts += peer.last_word.text;
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

  Fabric& fabric;
  RankSilence silence;
  std::optional<Chaos> disturbance;
  std::uint32_t node_count;
  std::vector<bool> is_here;
  MailboxCapacity outbox_capacity;
  LocalMemory outbox_memory;
  Mailbox outbox;
  Outlet outlet;
  std::size_t frame_bytes;
  NodeThreads nodes;
  CountingWaves waves;
  std::vector<Peer> peers;  ///< by rank, this one included
  std::vector<Way> ways;    ///< likewise
  RankTraffic traffic;
  Nap nap;
  bool started = false, is_closing = false;
};

RanksRunner::RanksRunner(std::span<const NodeSpecification> specifications, Fabric& fabric, const std::optional<Chaos>& chaos,
                         Observer* observer, const RankSilence& silence)
    : implementation_(std::make_unique<Implementation>(specifications, fabric, chaos, observer, silence)) {}
RanksRunner::~RanksRunner() = default;

RunEnd RanksRunner::run(std::stop_token stop) { return implementation_->run(std::move(stop)); }

Node& RanksRunner::node(std::size_t index) { return implementation_->nodes.processor(index).node; }
Program& RanksRunner::program(std::size_t index) { return *implementation_->nodes.processor(index).program; }
bool RanksRunner::is_here(std::size_t index) const { return implementation_->nodes.is_here(index); }

RankTraffic RanksRunner::traffic() const {
  RankTraffic traffic = implementation_->traffic;
  for (const Way& way : implementation_->ways) {
    traffic.frames_sent += way.frames();
  }
  traffic.waves = implementation_->waves.waves();
  traffic.network_bytes =
      implementation_->outbox_capacity.bytes() + 2 * implementation_->frame_bytes * (implementation_->ways.size() - 1);
  return traffic;
}

}  // namespace dmpc::nodes
