// The mailbox's real code in all its interleavings, and deliberate errors that this search must find.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "nodes/mailbox.h"
#include "tests/nodes/explored_atomics.h"

namespace dmpc::tests::mailbox_interleavings_test {
namespace {

using nodes::LocalMemory;
using nodes::MailboxCapacity;
using nodes::Packet;
using nodes::PacketHeader;
using Mailbox = nodes::BasicMailbox<ExploredAtomics>;
using AwakeCount = nodes::BasicAwakeCount<ExploredAtomics>;
template <class T>
using Atomic = ExploredAtomics::Atomic<T>;

void check(bool condition, const char* sentence) { Explorer::current().check(condition, sentence); }

nodes::MemoryPlan plan_for(const MailboxCapacity& capacity, std::size_t count) {
  nodes::MemoryPlan plan;
  plan[nodes::Category::mailbox] = count * Mailbox::bytes(capacity);
  return plan;
}

PacketHeader header_of(std::uint32_t source) {
  return {.bytes = sizeof(std::uint32_t), .source = static_cast<std::uint16_t>(source), .kind = 0};
}

bool push_number(Mailbox& mailbox, AwakeCount& awake, std::uint32_t source, std::uint32_t number) {
  return mailbox.push(header_of(source), std::as_bytes(std::span(&number, 1)), awake);
}

/// Two senders push numbers while there is room, the second all at once, then say that they are done and rouse the receiver,
/// which ends when both have. Slots are few, so that they come back in the middle.
struct TwoSenders {
  static constexpr std::size_t thread_count = 3;
  static constexpr std::size_t receiver = 0;
  static constexpr std::uint32_t per_sender = 2;
  static constexpr MailboxCapacity capacity{.small_slots = 2};

  TwoSenders() { ExploredAtomics::forget_cells(); }

  void thread(std::size_t index) { index == receiver ? receive() : send(index); }

  void send(std::size_t index) {
    Mailbox::Batch batch;
    for (std::uint32_t number = 0; number < per_sender; ++number) {
      const PacketHeader header = header_of(static_cast<std::uint32_t>(index));
      const auto payload = std::as_bytes(std::span(&pushed[index], 1));
      const bool fits = index == 2 ? mailbox.add(batch, header, payload) : mailbox.push(header, payload, awake);
      pushed[index] += fits ? 1 : 0;
    }
    mailbox.hand_over(batch, awake);
    done.fetch_sub(1, std::memory_order_relaxed);
    mailbox.rouse();
  }

  void receive() {
    while (true) {
      mailbox.drain([this](const Packet& packet) { take(packet); });
      if (mailbox.fall_asleep()) {
        if (done.load(std::memory_order_relaxed) == 0) {
          break;
        }
        mailbox.wait();
      }
    }
    mailbox.rouse();  // no longer asleep: what was sent since then is still to be taken
    mailbox.drain([this](const Packet& packet) { take(packet); });
  }

  void take(const Packet& packet) {
    std::uint32_t& next = received[index_of(packet.source)];
    check(packet.as<std::uint32_t>() == next, "each sender's packets arrive in order, none twice, none left out");
    ++next;
  }

  void finish() {
    check(received == pushed, "every packet that was pushed is received");
    std::uint32_t room = 0;
    while (push_number(mailbox, awake, 1, 0)) {
      ++room;
    }
    check(room == capacity.small_slots + 1, "at the end every slot is free");
  }

  LocalMemory memory{plan_for(capacity, 1)};
  Mailbox mailbox{capacity, memory};
  AwakeCount awake{3};
  Atomic<std::uint32_t> done{2};
  std::array<std::uint32_t, thread_count> pushed{};
  std::array<std::uint32_t, thread_count> received{};
};

/// A token makes its way through a small ring and everyone sleeps when it has nothing to do, as the runner does it: the last one
/// awake must be the last one, see everyone's state and end the run.
struct TokenRing {
  static constexpr std::size_t thread_count = 3;
  static constexpr std::uint32_t hops = 3;
  static constexpr MailboxCapacity capacity{.small_slots = 1};

  TokenRing() { ExploredAtomics::forget_cells(); }

  void thread(std::size_t index) {
    if (index == 0) {
      pass(index, hops);
    }
    while (true) {
      mailboxes[index].drain([this, index](const Packet& packet) { arrive(index, packet.as<std::uint32_t>()); });
      if (mailboxes[index].fall_asleep()) {
        if (ended.load(std::memory_order_relaxed) != 0) {
          return;
        }
        awake.leave() ? end() : mailboxes[index].wait();
      }
    }
  }

  void arrive(std::size_t index, std::uint32_t left) {
    ExploredAtomics::writes(&arrivals[index]);
    ++arrivals[index];
    if (left > 0) {
      pass(index, left);
    }
  }

  void pass(std::size_t index, std::uint32_t left) {
    check(push_number(mailboxes[(index + 1) % thread_count], awake, static_cast<std::uint32_t>(index), left - 1),
          "a token has room");
  }

  void end() {
    std::uint32_t sum = 0;
    for (const std::uint32_t& count : arrivals) {
      ExploredAtomics::reads(&count);
      sum += count;
    }
    check(sum == hops, "nobody is awake only when nothing is under way");
    ended.store(1, std::memory_order_relaxed);
    for (Mailbox& mailbox : mailboxes) {
      mailbox.rouse();
    }
  }

  void finish() { check(ended.load(std::memory_order_relaxed) == 1, "the end is found"); }

  LocalMemory memory{plan_for(capacity, thread_count)};
  std::array<Mailbox, thread_count> mailboxes{Mailbox(capacity, memory), Mailbox(capacity, memory), Mailbox(capacity, memory)};
  AwakeCount awake{thread_count};
  Atomic<std::uint32_t> ended{0};
  std::array<std::uint32_t, thread_count> arrivals{};
};

/// Instrumented code is some fifty times slower, and a sanitizer has nothing to find in the other interleavings.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int preemptions_max = 1;
constexpr std::uint64_t executions_max = 5'000;
#else
constexpr int preemptions_max = 2;
constexpr std::uint64_t executions_max = 400'000;
#endif

/// Both scenarios within the same bounds, until something goes wrong.
Exploration explore_all(const ExplorerOptions& options) {
  Exploration result = Explorer(options).explore<TwoSenders>();
  if (result.failure.empty()) {
    result = Explorer(options).explore<TokenRing>();
  }
  return result;
}

/// What a search finds out about a deliberate error: cheap bounds first. Empty if nothing.
std::string failure_of(const Mutation& mutation) {
  std::string failure;
  for (const auto& [preemptions, stale_loads] : {std::pair{1, 1}, std::pair{2, 0}, std::pair{2, 1}}) {
    if (failure.empty()) {
      failure = explore_all({.preemptions_max = preemptions, .stale_loads_max = stale_loads, .mutation = mutation}).failure;
    }
  }
  return failure;
}

/// The orders below `order`.
std::vector<std::memory_order> weaker_than(std::memory_order order) {
  if (order == std::memory_order_acq_rel) {
    return {std::memory_order_acquire, std::memory_order_release, std::memory_order_relaxed};
  }
  return {std::memory_order_relaxed};
}

std::vector<OrderedSite> ordered_sites() {
  std::vector<OrderedSite> sites = Explorer({.preemptions_max = 1}).explore<TwoSenders>().sites;
  for (const OrderedSite& site : Explorer({.preemptions_max = 1}).explore<TokenRing>().sites) {
    if (std::find(sites.begin(), sites.end(), site) == sites.end()) {
      sites.push_back(site);
    }
  }
  return sites;
}

TEST_CASE("two senders and a receiver are right in every interleaving with few preemptions") {
  const Exploration result = Explorer({.preemptions_max = preemptions_max}).explore<TwoSenders>();
  CHECK(result.failure == "");
  CHECK(result.is_complete);
}

TEST_CASE("the last node awake is the last in every interleaving with few preemptions") {
  const Exploration result = Explorer({.preemptions_max = preemptions_max}).explore<TokenRing>();
  CHECK(result.failure == "");
  CHECK(result.is_complete);
}

TEST_CASE("mailbox and awake count are right when any one load returns an old value") {
  const Exploration senders =
      Explorer({.preemptions_max = 1, .stale_loads_max = 1, .executions_max = executions_max}).explore<TwoSenders>();
  const Exploration ring =
      Explorer({.preemptions_max = 1, .stale_loads_max = 1, .executions_max = executions_max}).explore<TokenRing>();
  CHECK(senders.failure == "");
  CHECK(ring.failure == "");
}

TEST_CASE("every memory order stronger than relaxed is needed") {
  const std::vector<OrderedSite> sites = ordered_sites();
  CHECK(sites.size() == 7);
  for (const OrderedSite& site : sites) {
    for (const std::memory_order order : weaker_than(site.order)) {
      CAPTURE(site.file);
      CAPTURE(site.line);
      CAPTURE(site.on_failure);
      CAPTURE(static_cast<int>(order));
      CHECK(failure_of({Mutation::Kind::weaker_order, site.file, site.line, site.on_failure, order}) != "");
    }
  }
}

TEST_CASE("a free list without a tag is found out, even where every load returns the newest value") {
  const Mutation no_tag{.kind = Mutation::Kind::half_compare};
  CHECK(Explorer({.preemptions_max = 2, .mutation = no_tag}).explore<TwoSenders>().failure != "");
}

TEST_CASE("going to sleep without a look is found out") { CHECK(failure_of({.kind = Mutation::Kind::blind_compare}) != ""); }

TEST_CASE("a forgotten wake-up is found out") { CHECK(failure_of({.kind = Mutation::Kind::no_wake}) != ""); }

TEST_CASE("counting the woken node too late is found out") { CHECK(failure_of({.kind = Mutation::Kind::late_raise}) != ""); }

}  // namespace
}  // namespace dmpc::tests::mailbox_interleavings_test
