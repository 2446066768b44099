#include "apps/lab/bench/speed/question_ring.h"

#include <array>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "nodes/program.h"
#include "nodes/runner.h"
#include "nodes/threads/threads_runner.h"

namespace dmpc::apps {
namespace {

constexpr nodes::Channel question_channel = 0, answer_channel = 1;
constexpr nodes::PacketKind question_kind = 0, answer_kind = 1;
using Page = std::array<std::uint64_t, 128>;

nodes::MailboxCapacity mailbox_of(const QuestionRing& ring) {
  return {.small_slots = (ring.node_count - 1) * ring.items_in_flight,  // questions: all that the other nodes may ask at once
          .bulk_slots = ring.items_in_flight,                           // answers to this node's own
          .bulk_payload_bytes = sizeof(Page)};
}

/// One of the nodes.
class Asker final : public nodes::Program {
 public:
  Asker(nodes::Node& node, const QuestionRing& ring) : node_(&node), ring_(ring), free_(ring.items_in_flight) {
    for (std::uint32_t i = 0; i < ring.node_count; ++i) {
      node.grant(nodes::NodeId{i}, question_channel, ring.items_in_flight);
    }
  }

  void receive(const nodes::Packet& packet) override {
    if (packet.kind == question_kind) {
      node_->grant(packet.source, answer_channel);  // its place was reserved when the question left
      node_->send_reserved(packet.source, answer_channel, answer_kind, Page{state_});
    } else {
      node_->grant(packet.source, question_channel);
      state_ ^= packet.as<Page>()[0];
      ++answered_;
    }
  }
  /// Works on an item whose answer is here, or asks for the next.
  bool work() override {
    if (answered_ > 0) {
      --answered_;
      ++free_;
      ++done_;
      state_ = work_on_item(state_, ring_.steps);
    } else if (may_ask()) {
      node_->send_reserved(next_home(), question_channel, question_kind, std::uint64_t{asked_});
      --free_;
      ++asked_;
    }
    return answered_ > 0 || may_ask();
  }
  bool finished() const override { return done_ == ring_.items_a_node; }
  std::string describe() const override { return std::to_string(asked_ - done_) + " items under way"; }

 private:
  bool may_ask() const { return free_ > 0 && asked_ < ring_.items_a_node; }
  /// Another node, by chance.
  nodes::NodeId next_home() const {
    const std::uint32_t self = nodes::index_of(node_->id());
    const auto step = static_cast<std::uint32_t>(core::mix((std::uint64_t{self} << 32U) | asked_) % (ring_.node_count - 1));
    return nodes::NodeId{(self + 1 + step) % ring_.node_count};
  }

  nodes::Node* node_;
  QuestionRing ring_;
  std::uint32_t free_, answered_ = 0, asked_ = 0, done_ = 0;
  std::uint64_t state_ = 1;
};

nodes::NodeSpecification specification_of(const QuestionRing& ring) {
  const nodes::MailboxCapacity mailbox = mailbox_of(ring);
  return {.plan = nodes::memory_beside_program(mailbox, ring.node_count + 1, 0, nodes::thread_stack_bytes_min),
          .mailbox = mailbox,
          .make_program = [ring](nodes::Node& node) { return std::make_unique<Asker>(node, ring); }};
}

nodes::NodeSpecification idle_host(const QuestionRing& ring) {
  return {.plan = nodes::memory_beside_program({}, ring.node_count + 1, 0, nodes::thread_stack_bytes_min),
          .mailbox = {},
          .make_program = [](nodes::Node&) { return std::make_unique<nodes::IdleProgram>(); }};
}

}  // namespace

std::uint64_t work_on_item(std::uint64_t from, std::uint64_t steps) {
  for (; steps > 0; --steps) {
    from = (from ^ (from >> 32U)) * 0x9E3779B97F4A7C15U;
  }
  return from;
}

double seconds_a_step() {
  constexpr std::uint64_t steps = 2'000'000;
  ProcessorStopwatch stopwatch(CLOCK_THREAD_CPUTIME_ID);
  const std::uint64_t end = work_on_item(1, steps);
  const double seconds = stopwatch.lap();
  core::expect(end != 0 && seconds > 0, "work takes time");
  return seconds / steps;
}

Times times_of(const QuestionRing& ring, RunnerKind runner) {
  core::expect(ring.node_count > 1, "who asks has somebody to ask");
  nodes::ComputerRequest computer{.node_count = ring.node_count};
  choose_pool(runner, computer);
  std::vector<nodes::NodeSpecification> specifications(ring.node_count, specification_of(ring));
  specifications.push_back(idle_host(ring));
  const auto run = nodes::make_runner(specifications, computer);
  DoubleStopwatch stopwatch;
  run->run(std::stop_token());
  const Times times = stopwatch.lap();
  std::uint64_t answers = 0;
  for (std::uint32_t i = 0; i < ring.node_count; ++i) {
    answers += run->node(i).counters().received[answer_kind].packets;
  }
  core::expect(answers == ring.item_count(), "every item is worked on once");
  return times;
}

Times times_of_work_alone(const QuestionRing& ring) {
  DoubleStopwatch stopwatch;
  std::uint64_t state = 1;
  for (std::uint64_t item = 0; item < ring.item_count(); ++item) {
    state = work_on_item(state, ring.steps);
  }
  core::expect(state != 0, "the work is done");
  return stopwatch.lap();
}

}  // namespace dmpc::apps
