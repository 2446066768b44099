// A program that asks its neighbour for squares, well or badly, and what came of a run of it.
#pragma once

#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "apps/computer/dmpc/computer.h"
#include "tests/apps/computer/ran.h"

namespace dmpc::tests {

enum class Fault : std::uint8_t {
  none,
  answers_nothing,  ///< waits for ever
  leaves_unanswered,
  answers_twice,
  sends_answer,
  sends_too_much,
  names_no_packet,
  names_no_node,
  charges_nothing_declared,
  allocates_too_much,
  allocates_all_there_could_be,
  allocates_late,
  takes_for_other,
  throws_a_number
};

enum RequesterPackets : Index { question, square };

/// Asks the next node for the squares of 0, 1, 2, ...
class Requester final : public Program {
 public:
  Requester(Node& node, std::uint32_t questions, Fault fault)
      : node_(node), fault_(fault), questions_(questions), sums_(node.allocate<std::uint64_t>(0, 2)) {
    if (fault == Fault::allocates_too_much) {
      node.allocate<std::byte>(0, 1);
    }
    if (fault == Fault::allocates_all_there_could_be) {
      node.allocate<double>(0, std::size_t{1} << 61);
    }
  }

  void receive(const Packet& packet) override {
    const auto value = fault_ == Fault::takes_for_other ? packet.as<std::uint64_t>() : packet.as<std::uint32_t>();
    if (packet.kind == square) {
      sums_[0] += value;
      ++answers_;
      return;
    }
    const auto squared = static_cast<std::uint32_t>(value * value);
    node_.charge(fault_ == Fault::charges_nothing_declared ? 1 : 0);
    if (fault_ != Fault::answers_nothing && fault_ != Fault::leaves_unanswered) {
      node_.answer(packet.source, square, std::as_bytes(std::span(&squared, 1)));
    }
    if (fault_ == Fault::answers_twice) {
      node_.answer(packet.source, square, std::as_bytes(std::span(&squared, 1)));
    }
  }

  bool work() override {
    if (fault_ == Fault::throws_a_number) {
      throw 42;
    }
    if (fault_ == Fault::allocates_late) {
      node_.allocate<std::byte>(1, 1);
    }
    if (asked_ == questions_) {
      return false;
    }
    const std::uint32_t values[20] = {asked_};
    const std::uint32_t target = fault_ == Fault::names_no_node ? node_.node_count() : node_.next();
    const Index packet = fault_ == Fault::names_no_packet ? 2 : fault_ == Fault::sends_answer ? Index{square} : Index{question};
    const std::size_t count = fault_ == Fault::sends_too_much ? 20 : 1;
    const bool may_send = fault_ != Fault::none || node_.sendable(target, packet) > 0;
    const bool is_sent = node_.try_send(target, packet, std::span<const std::uint32_t>(values, count));
    is_consistent_ = is_consistent_ && (fault_ != Fault::none || is_sent == may_send);
    asked_ += is_sent ? 1 : 0;
    return is_sent;
  }

  bool finished() const override { return fault_ == Fault::leaves_unanswered ? asked_ == 1 : answers_ == questions_; }
  std::string describe() const override { return std::to_string(asked_) + " asked"; }
  std::uint64_t outcome() const { return is_consistent_ ? sums_[0] : 0; }

 private:
  Node& node_;
  Fault fault_;
  std::uint32_t questions_, asked_ = 0, answers_ = 0;
  bool is_consistent_ = true;  ///< sendable() says what try_send() does
  std::span<std::uint64_t> sums_;
};

/// `may_ask`: questions of a node under way.
inline Application<Requester> requester(std::uint32_t questions, Fault fault = Fault::none, std::uint32_t may_ask = 2) {
  return {.description = "Ask for squares",
          .needs = [may_ask](std::uint32_t) -> Needs {
            return {
                .packets = {{.name = "question", .senders = from_previous(may_ask)}, {.name = "square", .answers = "question"}},
                .operations = {{"multiplication", 100}},
                .memory = {{"sums", sizeof(std::uint64_t) * 2}, {"late", 64}}};
          },
          .make = [questions, fault](Node& node) { return std::make_unique<Requester>(node, questions, fault); },
          .result =
              [](const std::vector<std::uint64_t>& sums) {
                return "sum " + std::to_string(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}));
              }};
}

/// As if the words were typed behind the program's name.
template <class P>
Ran run_with(const Application<P>& application, const std::vector<std::string>& words) {
  return ran("/somewhere/requester", words, [&](int count, const char* const* all) { return run(count, all, application); });
}

}  // namespace dmpc::tests
