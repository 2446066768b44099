// The request to a policy's process: the references of a node, and the caches to simulate.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/system/memory_file.h"
#include "svm/pages/page.h"

namespace dmpc::apps {

/// The answer is a line with the policy's name, then a line with the faults of each cache and the sum of their prices. Without
/// caches it is the name only.
struct PolicyRequest {
  std::uint32_t node = 0;
  std::vector<std::uint32_t> cache_pages;  ///< per cache
  std::vector<svm::PageId> references;
  std::vector<std::uint32_t> prices;  ///< of a miss of each reference; empty: 1
  std::string source;                 ///< source text of a Python policy
};

/// Writes five numbers (node, caches, bytes of the source, references, prices), then the caches, the references, the prices, and
/// the source, to the beginning of the file, where the process with its descriptor reads. Numbers have 32 bits in native byte
/// order.
void put_request(const MemoryFile& file, std::uint32_t node, std::span<const std::uint32_t> cache_pages,
                 std::span<const svm::PageId> references, std::span<const std::uint32_t> prices, std::string_view source);
/// Reads a request from a file to its end. Throws core::InternalError if it is malformed.
PolicyRequest take_request(int descriptor);

}  // namespace dmpc::apps
