// Runs a few threads through all their interleavings, with a bounded number of preemptions, one after the other on one real
// thread.
//
// A depth-first search over choices without stored states: an execution is determined by its list of choices (which thread takes
// the next step, which of several allowed values a load returns); the next execution repeats it up to the last choice that has
// another alternative. Source of the bound: M. Musuvathi, S. Qadeer, "Iterative context bounding for systematic testing of
// multithreaded programs", 2007: most errors need two preemptions or fewer.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <source_location>
#include <string>
#include <utility>
#include <vector>

#include "tests/nodes/fiber.h"

namespace dmpc::tests {

inline constexpr std::size_t explored_threads_max = 3;

/// A vector clock: how many steps of each thread are known.
struct Clock {
  std::array<std::uint32_t, explored_threads_max> time{};

  /// Knows what `other` knows, too.
  void join(const Clock& other) {
    for (std::size_t i = 0; i < time.size(); ++i) {
      time[i] = std::max(time[i], other.time[i]);
    }
  }
};

/// A deliberate error, put into the code under test by the atomics it runs on: shows that a search would find it.
struct Mutation {
  enum class Kind : std::uint8_t {
    none,
    weaker_order,   ///< at `file`, `line`, `on_failure` the order `order` instead of the one written there
    half_compare,   ///< compare-exchange of 64 bits compares the lower 32 only: no tag
    blind_compare,  ///< compare_exchange_strong exchanges whatever is there: no look before
    no_wake,        ///< a wake-up is forgotten
    late_raise      ///< an addition takes effect only when its thread next wakes another (or subtracts): too late
  };
  Kind kind = Kind::none;
  std::string file{};
  std::uint32_t line = 0;
  bool on_failure = false;
  std::memory_order order = std::memory_order_relaxed;
};

/// A place in the code under test with an order stronger than relaxed.
struct OrderedSite {
  std::string file;
  std::uint32_t line = 0;
  bool on_failure = false;
  std::memory_order order{};
  bool operator==(const OrderedSite&) const = default;
};

struct ExplorerOptions {
  int preemptions_max = 2;  ///< switches from a thread that could go on
  int stale_loads_max =
      0;  ///< loads in one execution that return an older value than the newest, where the memory model allows it
  std::uint64_t executions_max = 400'000;
  Mutation mutation{};
};

struct Exploration {
  std::uint64_t executions = 0;
  bool is_complete = false;  ///< all interleavings within the bounds were run
  std::string failure{};     ///< what went wrong in the last execution, or empty
  std::vector<OrderedSite> sites{};
};

/// One exploration at a time. Code under test reaches it by current().
class Explorer {
 public:
  explicit Explorer(ExplorerOptions options) : options_(std::move(options)) { instance() = this; }
  Explorer(const Explorer&) = delete;
  Explorer& operator=(const Explorer&) = delete;
  ~Explorer() { instance() = nullptr; }
  static Explorer& current() { return *instance(); }

  /// Runs all executions of a Scenario: constructed anew each time, then scenario.thread(i) for i < Scenario::thread_count
  /// interleaved, then scenario.finish(). Stops at the first failure.
  template <class Scenario>
  Exploration explore() {
    make_fibers<Scenario>();
    do {
      run_once<Scenario>();
      ++result_.executions;
    } while (result_.failure.empty() && advance() && result_.executions < options_.executions_max);
    fibers_.clear();
    return result_;
  }

  // ---- For scenarios
  // -----------------------------------------------------------------------------------------------------------

  /// Ends the execution as a failure unless `condition` holds.
  void check(bool condition, const char* sentence) {
    if (!condition) {
      fail(std::string("violated: ") + sentence);
    }
  }

  // ---- For the atomics
  // ---------------------------------------------------------------------------------------------------------

  const Mutation& mutation() const { return options_.mutation; }
  bool in_thread() const { return running_ >= 0; }
  /// The running thread; 0 during set-up and finish.
  std::size_t thread() const { return running_ >= 0 ? static_cast<std::size_t>(running_) : 0; }
  Clock& clock() { return clocks_[thread()]; }
  std::uint32_t now() const { return clocks_[thread()].time[thread()]; }

  /// Before every step on shared memory: maybe another thread goes first.
  void step() {
    if (!in_thread()) {
      return;
    }
    if (++steps_ > steps_max) {
      fail("no end after very many steps");
    }
    const int self = running_;
    switch_to(choose_thread());
    ++clocks_[static_cast<std::size_t>(self)].time[static_cast<std::size_t>(self)];
  }

  /// Which of `count` values, newest first, a load returns.
  std::size_t choose_age(std::size_t count) {
    if (!in_thread() || count <= 1 || stale_loads_ >= options_.stale_loads_max) {
      return 0;
    }
    const std::size_t age = choose(count);
    stale_loads_ += age > 0 ? 1 : 0;
    return age;
  }

  /// Blocks the running thread until unblock(place).
  void block(const void* place) {
    const auto self = thread();
    states_[self] = State::blocked;
    places_[self] = place;
    switch_to(choose_thread());
  }

  void unblock(const void* place) {
    for (std::size_t i = 0; i < explored_threads_max; ++i) {
      if (states_[i] == State::blocked && places_[i] == place) {
        states_[i] = State::runnable;
      }
    }
  }

  /// Ends the exploration. A thread is left where it stands: nothing on its stack owns anything.
  [[noreturn]] void fail(std::string failure) {
    result_.failure = std::move(failure);
    while (in_thread()) {
      switch_to(nobody);
    }
    throw Failed();
  }

  /// The order to use at a site, which is noted.
  std::memory_order order_at(std::memory_order order, const std::source_location& where, bool on_failure) {
    if (order == std::memory_order_relaxed || !in_thread()) {
      return order;
    }
    note({file_of(where), where.line(), on_failure, order});
    const Mutation& change = options_.mutation;
    const bool is_here = change.kind == Mutation::Kind::weaker_order && change.line == where.line() &&
                         change.on_failure == on_failure && change.file == file_of(where);
    return is_here ? change.order : order;
  }

 private:
  enum class State : std::uint8_t { absent, runnable, blocked, finished };
  struct Failed {};
  struct Choice {
    std::size_t taken;
    std::size_t count;
  };
  struct Thread {
    Explorer* explorer;
    std::size_t index;
  };
  static constexpr int steps_max = 5000;
  static constexpr int nobody = -1;

  static Explorer*& instance() {
    static Explorer* explorer = nullptr;
    return explorer;
  }

  static std::string file_of(const std::source_location& where) {
    const std::string path = where.file_name();
    return path.substr(path.find_last_of('/') + 1);
  }

  void note(OrderedSite site) {
    if (std::find(result_.sites.begin(), result_.sites.end(), site) == result_.sites.end()) {
      result_.sites.push_back(std::move(site));
    }
  }

  template <class Scenario>
  void make_fibers() {
    static_assert(Scenario::thread_count <= explored_threads_max);
    for (std::size_t i = 0; i < Scenario::thread_count; ++i) {
      threads_[i] = {this, i};
      fibers_.push_back(std::make_unique<Fiber>(body<Scenario>, &threads_[i]));
    }
  }

  /// What a fiber does: thread after thread of execution after execution.
  template <class Scenario>
  static void body(void* argument) {
    const Thread& self = *static_cast<Thread*>(argument);
    while (true) {
      try {
        static_cast<Scenario*>(self.explorer->scenario_)->thread(self.index);
      } catch (const std::exception& error) {
        self.explorer->fail(std::string("exception: ") + error.what());
      }
      self.explorer->states_[self.index] = State::finished;
      self.explorer->next_ = self.explorer->choose_thread();
      self.explorer->fibers_[self.index]->leave();
    }
  }

  template <class Scenario>
  void run_once() {
    reset();
    Scenario scenario;
    scenario_ = &scenario;
    for (std::size_t i = 0; i < Scenario::thread_count; ++i) {
      states_[i] = State::runnable;
    }
    run_threads();
    running_ = nobody;
    if (result_.failure.empty()) {
      try {
        scenario.finish();
      } catch (const Failed&) {
      }
    }
  }

  void reset() {
    depth_ = 0;
    steps_ = preemptions_ = stale_loads_ = 0;
    running_ = nobody;
    clocks_ = {};
    states_ = {};
  }

  void run_threads() {
    for (next_ = choose_thread(); next_ != nobody;) {
      running_ = next_;
      fibers_[thread()]->enter();
    }
    if (result_.failure.empty() && has(State::blocked)) {
      result_.failure = "all sleep, and nobody is left to wake them";
    }
  }

  bool has(State state) const { return std::find(states_.begin(), states_.end(), state) != states_.end(); }

  void switch_to(int next) {
    if (next == running_) {
      return;
    }
    next_ = next;
    fibers_[thread()]->leave();
  }

  /// The thread that takes the next step: the running one, or, as far as preemptions are left, another.
  int choose_thread() {
    if (!result_.failure.empty()) {
      return nobody;
    }
    std::array<int, explored_threads_max> candidates{};
    std::size_t count = 0;
    const bool can_go_on = in_thread() && states_[thread()] == State::runnable;
    if (can_go_on) {
      candidates[count++] = running_;
    }
    for (int i = 0; i < static_cast<int>(explored_threads_max); ++i) {
      if (i != running_ && states_[static_cast<std::size_t>(i)] == State::runnable) {
        candidates[count++] = i;
      }
    }
    if (count == 0) {
      return nobody;
    }
    const bool is_bound = can_go_on && preemptions_ >= options_.preemptions_max;
    const std::size_t taken = choose(is_bound ? 1 : count);
    preemptions_ += can_go_on && taken > 0 ? 1 : 0;
    return candidates[taken];
  }

  std::size_t choose(std::size_t count) {
    if (count == 1) {
      return 0;
    }
    if (depth_ == choices_.size()) {
      choices_.push_back({0, count});
    }
    return choices_[depth_++].taken;
  }

  /// Moves on to the next list of choices; false if there is none.
  bool advance() {
    while (!choices_.empty() && choices_.back().taken + 1 == choices_.back().count) {
      choices_.pop_back();
    }
    result_.is_complete = choices_.empty();
    if (!choices_.empty()) {
      ++choices_.back().taken;
    }
    return !choices_.empty();
  }

  ExplorerOptions options_;
  Exploration result_;
  std::vector<std::unique_ptr<Fiber>> fibers_;
  std::array<Thread, explored_threads_max> threads_{};
  void* scenario_ = nullptr;
  std::vector<Choice> choices_;
  std::size_t depth_ = 0;
  int steps_ = 0;
  int preemptions_ = 0;
  int stale_loads_ = 0;
  int running_ = nobody;
  int next_ = nobody;
  std::array<Clock, explored_threads_max> clocks_{};
  std::array<State, explored_threads_max> states_{};
  std::array<const void*, explored_threads_max> places_{};
};

}  // namespace dmpc::tests
