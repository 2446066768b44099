// The groups of micro-benchmarks, and how a benchmark comes to be one row of a group.
//
// A row's name is "group/subject"; the first row of a group is what the others are compared with. What a row has done is a number
// of items (references, packets, events); its time is that of one. Every row checks its answers by core::expect, so that
// what is broken ends the program and cannot look fast.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

namespace dmpc::bench {

/// Registers the rows of a group, before the benchmarks are run.
void add_pager_rows();
void add_mailbox_rows();
void add_virtual_runner_rows();

/// A row timed by the processor time of its thread: of loops on one thread. `work(state)` says how many items it has done.
template <class Work>
benchmark::internal::Benchmark* add_row(const std::string& group, const std::string& subject, Work work) {
  return benchmark::RegisterBenchmark((group + '/' + subject).c_str(), work);
}

/// A row timed by itself: `measure()` does `item_count` items and returns the wall-clock seconds that they took. Once for each
/// repetition, so that the median passes over those in which others had the cores.
template <class Measure>
void add_timed_row(const std::string& group, const std::string& subject, std::uint64_t item_count, Measure measure) {
  add_row(group, subject,
          [item_count, measure](benchmark::State& state) {
            for (auto _ : state) {
              state.SetIterationTime(measure());
            }
            state.SetItemsProcessed(static_cast<std::int64_t>(item_count) * state.iterations());
          })
      ->UseManualTime()
      ->Iterations(1);
}

}  // namespace dmpc::bench
