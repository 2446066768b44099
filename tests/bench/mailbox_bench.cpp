// Packets through a mailbox, beside boost: how many get through, and how long there and back.
//
// Nobody who has to wait spins: he gives his core away (or, in the rows that say so, sleeps), as there may be more threads than
// cores.
#include <chrono>
#include <latch>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "core/base/expect.h"
#include "tests/bench/groups.h"
#include "tests/bench/rivals.h"

namespace dmpc::bench {
namespace {

constexpr std::size_t small_bytes = nodes::small_payload_bytes;
constexpr std::size_t page_bytes = 1024;
constexpr std::uint32_t messages_a_measurement = 32768;
constexpr std::uint32_t round_trips_a_measurement = 2048;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Tries until there is room.
template <class Queue, class T>
void send(Queue& queue, std::uint32_t sender, const T& message) {
  while (!queue.push(sender, message)) {
    std::this_thread::yield();
  }
}

template <class T>
T message_of(std::uint32_t sender, std::uint32_t number) {
  T message;
  message.sender = sender;
  message.number = number;
  message.check = check_of(sender, number);
  return message;
}

/// What has come, and whether it was right. Judged on the receiver's thread.
class Receipts {
 public:
  explicit Receipts(std::uint32_t sender_count) : next_(sender_count, 0) {}

  template <class T>
  void take(const T& message) {
    const bool is_whole = message.sender < next_.size() && message.check == check_of(message.sender, message.number);
    core::expect(is_whole && message.number == next_[message.sender], "messages come whole and in their sender's order");
    ++next_[message.sender];
    ++count_;
  }
  std::uint32_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> next_;
  std::uint32_t count_ = 0;
};

/// Seconds from the start of the senders until the receiver, the calling thread, has had all their messages.
template <class Queue, class T>
double traffic(std::uint32_t sender_count) {
  const std::uint32_t share = messages_a_measurement / sender_count;
  Queue queue(sender_count);
  std::latch start(sender_count + 1);
  std::vector<std::jthread> senders;
  for (std::uint32_t index = 0; index < sender_count; ++index) {
    senders.emplace_back([&queue, &start, index, share] {
      start.arrive_and_wait();
      for (std::uint32_t number = 0; number < share; ++number) {
        send(queue, index, message_of<T>(index, number));
      }
    });
  }
  Receipts receipts(sender_count);
  start.arrive_and_wait();
  const Clock::time_point begin = Clock::now();
  while (receipts.count() < share * sender_count) {
    if (!queue.drain([&](const T& message) { receipts.take(message); })) {
      std::this_thread::yield();
    }
  }
  return seconds_since(begin);
}

/// A few messages in, the same out, on one thread: what a queue costs when nobody is in its way.
template <class Queue, class T>
void in_and_out(benchmark::State& state) {
  constexpr std::uint32_t batch = 32;
  Queue queue(1);
  Receipts receipts(1);
  std::uint32_t number = 0;
  for (auto _ : state) {
    for (std::uint32_t i = 0; i < batch; ++i, ++number) {
      core::expect(queue.push(0, message_of<T>(0, number)), "a queue has room for a few");
    }
    core::expect(queue.drain([&](const T& message) { receipts.take(message); }), "what went in is there");
  }
  core::expect(receipts.count() == number, "each message comes out once");
  state.SetItemsProcessed(number);
}

struct Yielding {
  template <class Queue>
  static void wait(Queue& /*queue*/) {
    std::this_thread::yield();
  }
};
struct Sleeping {
  template <class Queue>
  static void wait(Queue& queue) {
    queue.sleep();
  }
};

/// Waits for the next message.
template <class Wait, class T, class Queue>
void receive(Queue& queue, Receipts& receipts) {
  while (!queue.drain([&](const T& message) { receipts.take(message); })) {
    Wait::wait(queue);
  }
}

/// Seconds in which a message goes there and another one comes back, again and again.
template <class Queue, class T, class Wait>
double ping_pong() {
  Queue there(1), back(1);
  std::latch start(2);
  std::jthread echo([&] {
    Receipts receipts(1);
    start.arrive_and_wait();
    for (std::uint32_t number = 0; number < round_trips_a_measurement; ++number) {
      receive<Wait, T>(there, receipts);
      send(back, 0, message_of<T>(0, number));
    }
  });
  Receipts receipts(1);
  start.arrive_and_wait();
  const Clock::time_point begin = Clock::now();
  for (std::uint32_t number = 0; number < round_trips_a_measurement; ++number) {
    send(there, 0, message_of<T>(0, number));
    receive<Wait, T>(back, receipts);
  }
  core::expect(receipts.count() == round_trips_a_measurement, "each message is answered once");
  return seconds_since(begin);
}

template <class Queue, class T>
void add_in_and_out(const std::string& group) {
  add_row(group, Queue::name, in_and_out<Queue, T>);
}

template <class Queue, class T>
void add_traffic(const std::string& group, std::uint32_t senders) {
  add_timed_row(group, Queue::name, messages_a_measurement, [senders] { return traffic<Queue, T>(senders); });
}

template <class Queue, class T, class Wait = Yielding>
void add_ping_pong(const std::string& group, const std::string& subject = Queue::name) {
  add_timed_row(group, subject, round_trips_a_measurement, [] { return ping_pong<Queue, T, Wait>(); });
}

template <std::size_t payload_bytes>
void add_size(const std::string& size) {
  using T = Message<payload_bytes>;
  static_assert(sizeof(T) == payload_bytes && std::is_trivially_copyable_v<T>);
  const std::string alone = size + " in and out on one thread";
  add_in_and_out<BoostQueue<T>, T>(alone);
  add_in_and_out<OwnQueue<T>, T>(alone);
  for (const std::uint32_t senders : {1U, 8U}) {
    const std::string group = size + " from " + std::to_string(senders) + (senders == 1 ? " sender" : " senders");
    add_traffic<BoostQueue<T>, T>(group, senders);
    add_traffic<OwnQueue<T>, T>(group, senders);
  }
  const std::string both_ways = size + " there and back";
  add_ping_pong<BoostQueue<T>, T>(both_ways);
  add_ping_pong<OwnQueue<T>, T>(both_ways);
  add_ping_pong<OwnQueue<T>, T, Sleeping>(both_ways, "nodes::Mailbox, receiver asleep");
}

}  // namespace

void add_mailbox_rows() {
  add_size<small_bytes>("packets of 64 B");
  add_size<page_bytes>("packets of 1 KiB");
}

}  // namespace dmpc::bench
