#include "nodes/ranks/ranks_runner.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <utility>

#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/base/usual_arithmetic.h"
#include "nodes/processors.h"
#include "nodes/ranks/clock_talk.h"
#include "nodes/ranks/closing_talk.h"
#include "nodes/ranks/counting_talk.h"
#include "nodes/ranks/dismissal.h"
#include "nodes/ranks/exchange.h"
#include "nodes/ranks/failure.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/gathering_talk.h"
#include "nodes/threads/node_threads.h"
#include "nodes/threads/promptness.h"

namespace dmpc::nodes {
namespace {

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

/// While nodes carry, the communicating thread's sleeps are longer by this factor: it polls only in case all awake nodes are
/// preempted or in long quanta.
constexpr int leisure = 16;

std::size_t payload_bytes_max(std::span<const NodeSpecification> specifications) {
  return core::max_over(specifications, small_payload_bytes,
                        [&](const NodeSpecification& specification) { return specification.mailbox.bulk_payload_bytes; });
}

}  // namespace

/// Each kind of item belongs to one talk. Thread safety: the nodes' threads use `nodes` and, through it, the outbox. While nodes
/// run, everything else belongs to the holder of `carrying`: the communicating thread unless it sleeps, or a node's in carry().
struct RanksRunner::Implementation final : Carrier {
  Implementation(std::span<const NodeSpecification> specifications, RankLinks& to, const std::optional<Chaos>& chaos,
                 Observer* observer, const std::optional<std::uint32_t>& pool_threads)
      : links(to),
        disturbance(chaos),
        is_here(here(specifications.size(), to)),
        outbox_capacity(outbox_of(specifications, is_here)),
        outbox_memory(plan_of(outbox_capacity)),
        outbox(outbox_capacity, outbox_memory),
        call_memory(plan_of({})),
        call({}, call_memory),
        outlet{is_here, outbox, call, *this},
        nodes(specifications, chaos, observer, &outlet, pool_threads),
        exchange(to),
        compares_clocks(observer != nullptr && to.rank() == 0),
        clocks(to, compares_clocks),
        counting(to, nodes, outbox, node_count()),
        closing(to, nodes),
        gathering(to, is_here.size()) {
    core::expect(specifications.size() > to.rank_count(), "each rank has a node");
    core::expect(frame_bytes_for(payload_bytes_max(specifications)) <= to.frame_bytes(), "every packet fits a frame");
  }

  std::uint32_t node_count() const { return static_cast<std::uint32_t>(is_here.size() - 1); }

  /// A rank sends items of the next run only after rank 0's start message; rank 0 then knows that all ranks are here again.
  void begin_again() {
    nodes.begin_again();
    clocks = ClockTalk(links, compares_clocks);
    counting = CountingTalk(links, nodes, outbox, node_count());
    closing = ClosingTalk(links, nodes);
    gathering = GatheringTalk(links, is_here.size());
    has_started = false;
  }

  RunEnd run(std::stop_token stop) {
    if (std::exchange(is_run, true)) {
      begin_again();
    }
    const Promptness promptness;
    const std::stop_callback on_stop(std::move(stop), [this] { nodes.end(Ending::interrupted); });
    while (true) {
      try {
        start_with_others();
        communicate_until([this] { return closing.is_closed(); });
        return end_with_others();
      } catch (const LostRank&) {
        nodes.fail(std::current_exception());
        nodes.join();
        throw;
      } catch (const Dismissed&) {  // while waiting for the start
        throw;
      } catch (...) {
        if (closing.is_closed()) {
          throw;
        }
        nodes.fail(std::current_exception());  // which is reported to the others
      }
    }
  }

  void start_with_others() {
    if (!std::exchange(has_started, true)) {
      clocks.start(while_nobody_fails());
      nodes.start(clocks.start_ns());
    }
  }

  RunEnd end_with_others() {
    counting.close_account();
    const RunEnd end = closing.judge(disturbance);
    if (end == RunEnd::finished) {
      counting.expect_nothing_lost();
      if (clocks.compares()) {
        clocks.ask_again(while_nobody_fails());
        communicate_until([this] { return clocks.is_over(); });
      }
    }
    return end;
  }

  /// Waits, without other work, until something has failed here or, as reported, elsewhere: what others wait for before the start
  /// may then never come.
  Wait while_nobody_fails() {
    return [this](const std::function<bool()>& is_done) {
      Exchange(links).turn_until([&] { return is_done() || nodes.ending() == Ending::failed; },
                                 [this](auto&&... item) { receive(item...); });
    };
  }

  void communicate_until(const std::function<bool()>& is_done) {
    std::unique_lock lock(carrying);
    while (!is_done()) {
      if (carry_failure) {
        std::rethrow_exception(std::exchange(carry_failure, nullptr));
      }
      exchange.turn([this](auto&&... item) { receive(item...); }, [this] { return serve_nodes(); },
                    [&](std::chrono::nanoseconds time) { sleep(time, lock); });
    }
  }
  Wait communicating() {
    return [this](const std::function<bool()>& is_done) { communicate_until(is_done); };
  }

  void receive(std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
    if (counting.receive(rank, header, bytes) || closing.receive(rank, header, bytes) || gathering.receive(rank, header, bytes) ||
        clocks.receive(rank, header, bytes)) {
      return;
    }
    if (header.item == Item::dismissal) {
      throw Dismissed{value_of<int>(bytes)};
    }
    core::expect(header.item == Item::failure, "what a run is made from comes before it");
    if (!closing.has_reported_of_failure(rank)) {  // else it belongs to the run, and this rank knows of it
      fail_as_said(links.name_of(rank), bytes);
    }
  }

  /// Does the communicating thread's work, but wakes it if there is more to do than to carry packets.
  void carry() override {
    const std::unique_lock lock(carrying, std::try_to_lock);
    if (!lock || carry_failure || nodes.ending() != Ending::none) {
      return;
    }
    bool is_word = false;
    try {
      links.take([&](std::uint32_t rank, const ItemHeader& header, std::span<const std::byte> bytes) {
        is_word = is_word || header.item != Item::packet;
        receive(rank, header, bytes);
      });
      counting.send_packets();
      links.flush();
      core::use_usual_arithmetic();  // libraries loaded at first contact with a rank may have changed it
    } catch (...) {
      carry_failure = std::current_exception();
    }
    if (is_word || carry_failure) {
      call.rouse();
    }
  }

  /// Returns whether there was anything to send.
  bool serve_nodes() {
    if (nodes.ending() == Ending::none) {
      const bool has_moved = counting.send_packets();
      counting.count_if_quiet();
      return has_moved;
    }
    if (!closing.is_closing()) {
      counting.close();
      closing.close();
    }
    return false;
  }

  /// The order matters: ASLEEP first, so that the last node to sleep, which would have carried, either finds it or is seen.
  void sleep(std::chrono::nanoseconds time, std::unique_lock<std::mutex>& lock) {
    core::expect(call.fall_asleep(), "nothing is put before a communicating thread");
    // Whoever woke this thread before it slept has left something visible.
    const bool is_something_new =
        !closing.is_closing() && (nodes.ending() != Ending::none || (counting.is_to_count() && outbox.is_drained()));
    const bool do_nodes_carry = !closing.is_closing() && !nodes.all_sleep();
    lock.unlock();
    call.wait(is_something_new ? time.zero() : do_nodes_carry ? leisure * time : time);
    lock.lock();
    if (do_nodes_carry && nodes.all_sleep()) {
      exchange.end_backoff();
    }
  }

  std::vector<RankReport> gather_ranks(const std::string& reported) {
    std::vector<RankReport> reports = gathering.gather_ranks({counting.traffic(), {}, reported}, communicating());
    for (std::uint32_t rank = 1; rank < reports.size(); ++rank) {
      reports[rank].clock = clocks.drift_of(rank);
    }
    return reports;
  }

  RankLinks& links;
  std::optional<Chaos> disturbance;
  std::vector<bool> is_here;
  MailboxCapacity outbox_capacity;
  LocalMemory outbox_memory;
  Mailbox outbox;
  LocalMemory call_memory;
  Mailbox call;  ///< the communicating thread's, to sleep at: always empty
  std::mutex carrying;
  std::exception_ptr carry_failure;  ///< thrown on a node's thread in carry()
  Outlet outlet;
  NodeThreads nodes;
  Exchange exchange;
  bool compares_clocks;
  ClockTalk clocks;
  CountingTalk counting;
  ClosingTalk closing;
  GatheringTalk gathering;
  bool is_run = false, has_started = false;
};

RanksRunner::RanksRunner(std::span<const NodeSpecification> specifications, RankLinks& links, const std::optional<Chaos>& chaos,
                         Observer* observer, const std::optional<std::uint32_t>& pool_threads)
    : implementation_(std::make_unique<Implementation>(specifications, links, chaos, observer, pool_threads)) {}
RanksRunner::~RanksRunner() = default;

RunEnd RanksRunner::run(std::stop_token stop) { return implementation_->run(std::move(stop)); }

Node& RanksRunner::node(std::size_t index) { return implementation_->nodes.processor(index).node; }
Program& RanksRunner::program(std::size_t index) { return *implementation_->nodes.processor(index).program; }
bool RanksRunner::is_here(std::size_t index) const { return implementation_->nodes.is_here(index); }

/// Call this on every rank after the run, when nothing else is in flight.
std::vector<std::string> RanksRunner::gather(const Report& report) {
  Implementation& runner = *implementation_;
  return runner.gathering.gather(reported_by(runner.nodes.processors(), runner.is_here.size(), report), runner.communicating());
}

std::vector<RankReport> RanksRunner::gather_ranks(const std::string& reported) { return implementation_->gather_ranks(reported); }
RankTraffic RanksRunner::traffic() const { return implementation_->counting.traffic(); }

}  // namespace dmpc::nodes
