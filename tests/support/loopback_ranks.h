// Ranks of one process, each on a thread of its own.
#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

#include "nodes/ranks/loopback.h"

namespace dmpc::tests {

/// What a rank's function returned, or threw.
template <class T>
struct RankResult {
  std::optional<T> value;
  std::exception_ptr failure;

  /// Empty without a failure.
  std::string failure_text() const {
    try {
      if (failure) {
        std::rethrow_exception(failure);
      }
    } catch (const std::exception& error) {
      return error.what();
    }
    return {};
  }
};

/// Calls run(fabric) for each rank. By rank.
template <class Run>
auto on_ranks(std::uint32_t rank_count, const nodes::LoopbackTrouble& trouble, const Run& run,
              std::size_t frame_bytes = nodes::frame_bytes_min) {
  using T = std::invoke_result_t<const Run&, nodes::Fabric&>;
  nodes::Loopback loopback(rank_count, trouble, frame_bytes);
  std::vector<RankResult<T>> results(rank_count);
  {
    std::vector<std::jthread> threads;
    for (std::uint32_t rank = 0; rank < rank_count; ++rank) {
      threads.emplace_back([&, rank] {
        try {
          results[rank].value.emplace(run(loopback.rank(rank)));
        } catch (...) {
          results[rank].failure = std::current_exception();
        }
      });
    }
  }
  return results;
}

}  // namespace dmpc::tests
