// The mailbox under load: many senders, few slots, threads that are taken off their core anywhere.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "nodes/mailbox.h"

namespace dmpc::nodes::mailbox_stress_test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint32_t packets_total = 60'000;
#else
constexpr std::uint32_t packets_total = 300'000;
#endif

/// What a sender sends: its number in the sequence, in a small or a bulk packet whose every byte follows from it.
struct Numbered {
  std::uint32_t number;
  std::array<std::uint8_t, 196> bytes;
};

struct Load {
  std::uint32_t senders;
  MailboxCapacity capacity;
  std::uint32_t packets_per_sender() const { return packets_total / senders; }
};

/// A receiver that sleeps, and senders that try again when there is no room. Facts are judged after the threads have ended.
class Storm {
 public:
  Storm(const Load& load, std::uint32_t seed)
      : load_(load),
        seed_(seed),
        memory_(plan(load.capacity)),
        mailbox_(load.capacity, memory_),
        awake_(load.senders + 1),
        next_(load.senders, 0) {}

  void run() {
    std::vector<std::thread> threads;
    for (std::uint32_t i = 0; i < load_.senders; ++i) {
      threads.emplace_back([this, i] { send(i); });
    }
    receive();
    for (std::thread& thread : threads) {
      thread.join();
    }
  }

  std::uint32_t received() const { return received_; }
  std::uint32_t wrong() const { return wrong_; }
  std::uint64_t refused() const { return refused_.load(); }
  bool is_empty() const { return !mailbox_.has_packets(); }
  std::uint32_t free_slots(bool small) {
    std::uint32_t count = 0;
    while (push(0, 0, small)) {
      ++count;
    }
    return count;
  }

 private:
  static MemoryPlan plan(const MailboxCapacity& capacity) {
    MemoryPlan plan;
    plan[Category::mailbox] = capacity.bytes();
    return plan;
  }

  static Numbered numbered(std::uint32_t number) {
    Numbered value{number, {}};
    value.bytes.fill(static_cast<std::uint8_t>(number));
    return value;
  }

  bool push(std::uint32_t sender, std::uint32_t number, bool small) {
    const Numbered value = numbered(number);
    const auto bytes = std::as_bytes(std::span(&value, 1)).first(small ? small_payload_bytes : sizeof(value));
    return mailbox_.push({.bytes = static_cast<std::uint32_t>(bytes.size()), .source = static_cast<std::uint16_t>(sender)}, bytes,
                         awake_);
  }

  void send(std::uint32_t sender) {
    std::minstd_rand random(seed_ + sender);
    for (std::uint32_t number = 0; number < load_.packets_per_sender(); ++number) {
      const bool small = random() % 4 != 0;
      while (!push(sender, number, small)) {
        refused_.fetch_add(1, std::memory_order_relaxed);
        std::this_thread::yield();
      }
      if (random() % 16 == 0) {
        std::this_thread::yield();
      }
    }
  }

  void receive() {
    std::minstd_rand random(seed_ ^ 0x5EEDU);
    while (received_ < load_.packets_per_sender() * load_.senders) {
      mailbox_.drain([this](const Packet& packet) { take(packet); });
      if (random() % 8 == 0) {
        std::this_thread::yield();
      }
      if (received_ < load_.packets_per_sender() * load_.senders && mailbox_.fall_asleep()) {
        static_cast<void>(awake_.leave());
        mailbox_.wait();
      }
    }
  }

  void take(const Packet& packet) {
    std::uint32_t number = 0;
    std::memcpy(&number, packet.payload.data(), sizeof(number));
    const bool in_order = next_[index_of(packet.source)]++ == number;
    const bool whole = packet.payload.back() == static_cast<std::byte>(number);
    wrong_ += in_order && whole ? 0 : 1;
    ++received_;
  }

  Load load_;
  std::uint32_t seed_;
  LocalMemory memory_;
  Mailbox mailbox_;
  AwakeCount awake_;
  std::vector<std::uint32_t> next_;
  std::uint32_t received_ = 0;
  std::uint32_t wrong_ = 0;
  std::atomic<std::uint64_t> refused_{0};
};

void check_storm(const Load& load) {
  const std::uint32_t seed = std::random_device{}();
  CAPTURE(seed);
  CAPTURE(load.senders);
  Storm storm(load, seed);
  storm.run();
  CHECK(storm.received() == load.packets_per_sender() * load.senders);
  CHECK(storm.wrong() == 0);
  CHECK(storm.is_empty());
  CHECK(storm.free_slots(true) == load.capacity.small_slots + 1);
  CHECK(storm.free_slots(false) == load.capacity.bulk_slots + 1);
}

TEST_CASE("no packet is lost, doubled or out of its sender's order through a mailbox that is mostly full") {
  for (const std::uint32_t senders : {1U, 2U, 16U, 63U}) {
    check_storm({senders, {.small_slots = 3, .bulk_slots = 1, .bulk_payload_bytes = sizeof(Numbered)}});
  }
}

TEST_CASE("no packet is lost, doubled or out of its sender's order through a mailbox that is mostly empty") {
  for (const std::uint32_t senders : {1U, 2U, 16U, 63U}) {
    check_storm({senders, {.small_slots = 1000, .bulk_slots = 300, .bulk_payload_bytes = sizeof(Numbered)}});
  }
}

}  // namespace
}  // namespace dmpc::nodes::mailbox_stress_test
