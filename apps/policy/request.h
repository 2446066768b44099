// What a policy's process is asked: to simulate caches with references that it gets at once, or to decide for the caches of a
// run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "svm/pages/page.h"

namespace dmpc::apps {

/// The first numbers of a request.
struct PolicyTask {
  std::uint32_t node = 0;
  std::uint32_t is_of_run = 0;     ///< batches of events follow, until the end of the file, and each is answered that asks
  std::uint32_t call_seconds = 0;  ///< processor time after which a call of the policy is an error
};

/// To simulate: the answer is a line with the policy's name, then a line with the faults of each cache and the sum of their
/// prices. Without caches it is the name only.
struct PolicyRequest {
  PolicyTask task;
  std::vector<std::uint32_t> cache_pages;  ///< per cache
  std::vector<svm::PageId> references;
  std::vector<std::uint32_t> prices;  ///< of a miss of each reference; empty: 1
  std::string source;                 ///< source text of a Python policy
};

/// What happens to one cache of a run. A batch of events is their count and then they.
struct PolicyEvent {
  enum class Kind : std::uint32_t {
    make,    ///< `page`: the number of frames
    hit,     ///< of a page in a frame
    insert,  ///< of a page into a frame
    victim,  ///< of the incoming page; asks: the answer is a frame or svm::bypass, as a number
    sync     ///< asks whether all is well so far: the answer is 0
  };
  static constexpr std::uint32_t kinds = 8;

  std::uint32_t node_and_kind = 0, page = 0, frame = 0;

  static PolicyEvent of(std::uint32_t node, Kind kind, std::uint32_t page = 0, std::uint32_t frame = 0) {
    return {node * kinds + static_cast<std::uint32_t>(kind), page, frame};
  }
  std::uint32_t node() const { return node_and_kind / kinds; }
  Kind kind() const { return Kind{node_and_kind % kinds}; }
};

/// Passes a request on in pieces: the task, the numbers of caches, bytes of the source, references and prices, then the caches,
/// the references, the prices, and the source. Numbers have 32 bits in native byte order.
using WriteBytes = std::function<void(const void* bytes, std::size_t count)>;
void put_request(const WriteBytes& write, const PolicyTask& task, std::span<const std::uint32_t> cache_pages,
                 std::span<const svm::PageId> references, std::span<const std::uint32_t> prices, std::string_view source);
/// Reads a request from a file. Throws core::InternalError if it is malformed.
PolicyRequest take_request(int descriptor);
/// Reads the next batch; false at the end of the file.
bool take_events(int descriptor, std::vector<PolicyEvent>& events);

}  // namespace dmpc::apps
