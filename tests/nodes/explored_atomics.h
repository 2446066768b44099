// The atomics policy of the explorer: a small model of the C++ memory orders, and a search for data races.
//
// Every location keeps its last few stores, each with the vector clock that its release hands on and the time at which each
// thread first knew of it. A load may return any store of which no newer one is known to the loading thread through
// happens-before (coherence); a read-modify-write, a failing compare-exchange and a sleeper's look see the newest.
// Read-modify-writes continue a release sequence. seq_cst and fences are not modelled: the code under test uses neither.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <source_location>
#include <unordered_map>

#include "tests/nodes/explorer.h"

namespace dmpc::tests {

constexpr bool acquires(std::memory_order order) {
  return order == std::memory_order_acquire || order == std::memory_order_acq_rel;
}
constexpr bool releases(std::memory_order order) {
  return order == std::memory_order_release || order == std::memory_order_acq_rel;
}

/// The last stores to one location.
class History {
 public:
  struct Store {
    std::uint64_t value = 0;
    Clock released;  ///< what an acquire of this store learns
    Clock known;     ///< per thread, its time when it first knew of the store
  };

  /// The initial store, known to all.
  explicit History(std::uint64_t value) { stores_[0].value = value; }

  /// The newest store, as a read-modify-write or a failing one sees it.
  std::uint64_t read_newest(std::memory_order order) { return see(newest(), order); }

  /// Some store that the memory model allows.
  std::uint64_t read_some(std::memory_order order) {
    Explorer& explorer = Explorer::current();
    return see(at_age(explorer.choose_age(age_limit(explorer.clock()))), order);
  }

  void write(std::uint64_t value, std::memory_order order, bool is_modification) {
    Explorer& explorer = Explorer::current();
    Store store{.value = value, .released = is_modification ? newest().released : Clock{}, .known = unknown()};
    if (releases(order)) {
      store.released.join(explorer.clock());
    }
    store.known.time[explorer.thread()] = explorer.now();
    ++count_;
    newest() = store;
  }

 private:
  static constexpr std::size_t depth = 4;

  static Clock unknown() {
    Clock clock;
    clock.time.fill(std::numeric_limits<std::uint32_t>::max());
    return clock;
  }

  Store& at_age(std::size_t age) { return stores_[(count_ - 1 - age) % depth]; }
  Store& newest() { return at_age(0); }

  static std::uint64_t see(Store& store, std::memory_order order) {
    Explorer& explorer = Explorer::current();
    std::uint32_t& known = store.known.time[explorer.thread()];
    known = std::min(known, explorer.now());
    if (acquires(order)) {
      explorer.clock().join(store.released);
    }
    return store.value;
  }

  /// How many of the newest stores a thread with this clock may read.
  std::size_t age_limit(const Clock& clock) {
    std::size_t age = 0;
    while (age + 1 < std::min(count_, depth) && !is_known(at_age(age), clock)) {
      ++age;
    }
    return age + 1;
  }

  static bool is_known(const Store& store, const Clock& clock) {
    bool known = false;
    for (std::size_t i = 0; i < clock.time.size(); ++i) {
      known = known || store.known.time[i] <= clock.time[i];
    }
    return known;
  }

  std::array<Store, depth> stores_{};
  std::size_t count_ = 1;
};

/// Plain bytes, known by their address: who wrote and who read them last.
class PlainCell {
 public:
  void read() {
    Explorer& explorer = Explorer::current();
    explorer.check(is_behind(writes_), "a read happens after the write before it (data race)");
    reads_.time[explorer.thread()] = explorer.now();
  }
  void write() {
    Explorer& explorer = Explorer::current();
    explorer.check(is_behind(writes_) && is_behind(reads_), "a write happens after all accesses before it (data race)");
    writes_.time[explorer.thread()] = explorer.now();
  }

 private:
  static bool is_behind(const Clock& accesses) {
    const Clock& clock = Explorer::current().clock();
    bool behind = true;
    for (std::size_t i = 0; i < clock.time.size(); ++i) {
      behind = behind && accesses.time[i] <= clock.time[i];
    }
    return behind;
  }

  Clock reads_;
  Clock writes_;
};

/// Drop-in for nodes::SystemAtomics inside an exploration.
struct ExploredAtomics {
  using Place = std::source_location;

  template <class T>
  class Atomic {
   public:
    Atomic() : Atomic(T{}) {}
    explicit Atomic(T value) : history_(value) {}

    T load(std::memory_order order, const Place& place = Place::current()) const {
      Explorer::current().step();
      return static_cast<T>(history_.read_some(Explorer::current().order_at(order, place, false)));
    }
    void store(T value, std::memory_order order, const Place& place = Place::current()) {
      Explorer::current().step();
      history_.write(value, Explorer::current().order_at(order, place, false), false);
    }
    T exchange(T value, std::memory_order order, const Place& place = Place::current()) {
      return modify(order, place, [value](T) { return value; });
    }
    T fetch_add(T value, std::memory_order order, const Place& place = Place::current()) {
      if (Explorer::current().mutation().kind == Mutation::Kind::late_raise && Explorer::current().in_thread()) {
        late()[Explorer::current().thread()] = {this, value};
        return T{};
      }
      return modify(order, place, [value](T old) { return static_cast<T>(old + value); });
    }
    T fetch_sub(T value, std::memory_order order, const Place& place = Place::current()) {
      catch_up();
      return modify(order, place, [value](T old) { return static_cast<T>(old - value); });
    }
    bool compare_exchange_weak(T& expected, T desired, std::memory_order success, std::memory_order failure,
                               const Place& place = Place::current()) {
      const bool is_half = sizeof(T) == 8 && Explorer::current().mutation().kind == Mutation::Kind::half_compare;
      return compare(expected, desired, success, failure, place, is_half ? T{0xFFFFFFFF} : static_cast<T>(~T{0}));
    }
    bool compare_exchange_strong(T& expected, T desired, std::memory_order success, std::memory_order failure,
                                 const Place& place = Place::current()) {
      const bool is_blind = Explorer::current().mutation().kind == Mutation::Kind::blind_compare;
      return compare(expected, desired, success, failure, place, is_blind ? T{0} : static_cast<T>(~T{0}));
    }

    /// What late_raise has kept back for the running thread takes effect.
    static void catch_up() {
      auto& [place, value] = late()[Explorer::current().thread()];
      if (place != nullptr) {
        const T added = value;
        Atomic* const word = place;
        place = nullptr;
        word->modify(std::memory_order_relaxed, Place::current(), [added](T old) { return static_cast<T>(old + added); });
      }
    }
    /// The newest value, without a step: what a sleeper's look sees.
    T newest() const { return static_cast<T>(history_.read_newest(std::memory_order_relaxed)); }

   private:
    struct Late {
      Atomic* place = nullptr;
      T value{};
    };
    static std::array<Late, explored_threads_max>& late() {
      static std::array<Late, explored_threads_max> kept;
      return kept;
    }

    template <class Change>
    T modify(std::memory_order order, const Place& place, Change change) {
      Explorer::current().step();
      const std::memory_order used = Explorer::current().order_at(order, place, false);
      const T old = static_cast<T>(history_.read_newest(used));
      history_.write(change(old), used, true);
      return old;
    }

    /// Compares the bits of `mask`.
    bool compare(T& expected, T desired, std::memory_order success, std::memory_order failure, const Place& place, T mask) {
      Explorer::current().step();
      const std::memory_order on_success = Explorer::current().order_at(success, place, false);
      const std::memory_order on_failure = Explorer::current().order_at(failure, place, true);
      if (((newest() ^ expected) & mask) != 0) {
        expected = static_cast<T>(history_.read_newest(on_failure));
        return false;
      }
      history_.read_newest(on_success);
      history_.write(desired, on_success, true);
      return true;
    }

    mutable History history_;
  };

  /// Without a time-out: no wake-up may be missing.
  static void sleep(const Atomic<std::uint32_t>& word, std::uint32_t value, std::chrono::nanoseconds /*most*/) {
    Explorer::current().step();
    if (word.newest() == value) {
      Explorer::current().block(&word);
    }
  }
  static void wake(const Atomic<std::uint32_t>& word) {
    Explorer::current().step();
    if (Explorer::current().mutation().kind != Mutation::Kind::no_wake) {
      Explorer::current().unblock(&word);
    }
    Atomic<std::uint32_t>::catch_up();
  }

  static void reads(const void* place) { cells()[place].read(); }
  static void writes(const void* place) { cells()[place].write(); }
  /// To be called when an execution begins.
  static void forget_cells() { cells().clear(); }

 private:
  static std::unordered_map<const void*, PlainCell>& cells() {
    static std::unordered_map<const void*, PlainCell> by_place;
    return by_place;
  }
};

}  // namespace dmpc::tests
