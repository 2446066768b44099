// Programs for tests of runners: they ask each other, send all to one, wait in vain, work for ever.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/base/expect.h"
#include "nodes/runner.h"
#include "tests/nodes/toy_machine.h"

namespace dmpc::tests {

template <class T>
T& program_of(nodes::Runner& runner, std::size_t index) {
  return dynamic_cast<T&>(runner.program(index));
}

inline constexpr nodes::Channel requests = 0;
inline constexpr nodes::Channel replies = 1;
inline constexpr nodes::PacketKind request = 1;
inline constexpr nodes::PacketKind reply = 2;

/// Asks every other node `count` times, with `window` requests to each under way at most; answers by a bulk packet.
class Requester : public ToyProgram {
 public:
  struct Answer {
    std::uint64_t question;
    std::array<std::uint64_t, 15> words;
  };

  static nodes::MailboxCapacity mailbox(std::uint32_t peer_count, std::uint32_t window) {
    return {.small_slots = (peer_count - 1) * window,  // every other node's requests under way to this one
            .bulk_slots = (peer_count - 1) * window,   // the replies to this node's own
            .bulk_payload_bytes = sizeof(Answer)};
  }

  Requester(nodes::Node& node, std::uint32_t count, std::uint32_t window) : ToyProgram(node), left_(node.peer_count()) {
    for (std::uint32_t i = 0; i < node.peer_count(); ++i) {
      node.grant(nodes::NodeId{i}, requests, window);
    }
    ask(count);
  }
  /// So many questions more, between two runs.
  void ask(std::uint32_t count) {
    std::fill(left_.begin(), left_.end(), count);
    left_[index()] = 0;
    unanswered_ = std::uint64_t{count} * (node().peer_count() - 1);
  }

  void receive(const nodes::Packet& packet) override { packet.kind == request ? answer(packet) : take(packet); }

  /// Sends as long as credits last; a refused question stays where it is.
  bool work() override {
    for (std::uint32_t i = 0; i < left_.size(); ++i) {
      if (left_[i] > 0 && node().try_send(nodes::NodeId{i}, requests, request, std::uint64_t{left_[i]})) {
        --left_[i];
        return true;
      }
    }
    return false;
  }

  bool finished() const override { return unanswered_ == 0; }
  std::string describe() const override { return std::to_string(unanswered_) + " unanswered"; }
  bool all_right() const { return wrong_ == 0; }

 private:
  void answer(const nodes::Packet& packet) {
    const auto question = packet.as<std::uint64_t>();
    node().grant(packet.source, replies);  // its place was reserved when the request left
    node().send_reserved(packet.source, replies, reply, Answer{question, {question * 3}});
  }
  void take(const nodes::Packet& packet) {
    const auto answer = packet.as<Answer>();
    wrong_ += answer.words[0] == 3 * answer.question ? 0 : 1;
    --unanswered_;
    node().grant(packet.source, requests);
  }

  std::vector<std::uint32_t> left_;
  std::uint64_t unanswered_ = 0;
  std::uint64_t wrong_ = 0;
};

/// Waits for a packet that nobody sends.
class Waiter : public ToyProgram {
 public:
  using ToyProgram::ToyProgram;
  bool finished() const override { return index() == 0; }
  std::string describe() const override { return "waits for Godot"; }
};

/// Works for ever, or fails in its hundredth quantum.
class Worker : public ToyProgram {
 public:
  Worker(nodes::Node& node, bool fails) : ToyProgram(node), fails_(fails) {}
  bool work() override {
    if (fails_ && node().counters().quanta == 100) {
      throw std::runtime_error("the hundredth quantum");
    }
    return true;
  }
  bool finished() const override { return false; }

 private:
  bool fails_;
};

/// Sends its numbers to the host, one in a quantum: kind 1 may wait, kind 2 not.
class Patient : public ToyProgram {
 public:
  static constexpr nodes::MailboxCapacity mailbox{.small_slots = 40};
  static constexpr std::uint32_t count = 38;

  Patient(nodes::Node& node, std::uint32_t hasty_one) : ToyProgram(node), hasty_one_(hasty_one), is_host_(node.id() == host()) {
    node.grant(host(), 0, count);
  }

  void receive(const nodes::Packet& packet) override { received_.push_back(packet.as<std::uint32_t>()); }
  bool work() override {
    if (is_host_ || sent_ == count) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100));  // so that the host goes to sleep again
    const nodes::PacketKind kind = sent_ == hasty_one_ ? 2 : 1;
    node().send_reserved(host(), 0, kind, sent_++);
    return sent_ < count;
  }
  bool finished() const override { return is_host_ ? received_.size() == count : sent_ == count; }
  const std::vector<std::uint32_t>& received() const { return received_; }

 private:
  std::uint32_t hasty_one_;
  std::uint32_t sent_ = 0;
  bool is_host_;
  std::vector<std::uint32_t> received_;
};

inline constexpr std::array<std::byte, 44> lasting{std::byte{1}, std::byte{2}};

/// Node 0 sends node 1 a packet that may wait, one with an immutable end, and a third; node 1 notes what it sees.
class SendsLasting : public ToyProgram {
 public:
  explicit SendsLasting(nodes::Node& node) : ToyProgram(node) { node.grant(nodes::NodeId{1}, 0, 3); }
  void receive(const nodes::Packet& packet) override {
    kinds.push_back(packet.kind);
    if (packet.kind == 2) {
      is_in_place = packet.immutable.data() == lasting.data();
      const std::span<const std::byte> end = packet.behind(sizeof(std::uint32_t));
      is_whole = std::equal(end.begin(), end.end(), lasting.begin(), lasting.end());
    }
  }
  bool work() override {
    if (index() == 0 && !has_sent_) {
      has_sent_ = true;
      const std::uint32_t front = 3;
      std::array<std::byte, sizeof(front) + sizeof(lasting)> room;
      node().send_reserved(nodes::NodeId{1}, 0, 1, front);
      core::expect(node().try_send(nodes::NodeId{1}, 0, 2, std::as_bytes(std::span(&front, 1)), lasting, room), "it has credits");
      node().send_reserved(nodes::NodeId{1}, 0, 3, front);
    }
    return false;
  }
  bool finished() const override { return index() == 0 ? has_sent_ : index() > 1 || kinds.size() == 3; }

  std::vector<nodes::PacketKind> kinds;
  bool is_in_place = false, is_whole = false;

 private:
  bool has_sent_ = false;
};

}  // namespace dmpc::tests
