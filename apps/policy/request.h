// What a policy's own process is asked: the references of a node, and the caches to feed them to.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/system/memory_file.h"
#include "svm/pages/page.h"

namespace dmpc::apps {

/// Its answer is text: a line with the policy's name, then for each cache a line with its faults. With no caches it is asked for
/// its name alone.
struct PolicyRequest {
  std::uint32_t node = 0;
  std::vector<std::uint32_t> cache_pages;  ///< per cache
  std::vector<svm::PageId> references;
  std::string source;  ///< source text of a Python policy
};

/// Four numbers (node, caches, bytes of the source, references), then the caches, the references, and the source: numbers of 32
/// bits in this computer's order. At the file's beginning, where who gets its descriptor reads.
void put_request(const MemoryFile& file, std::uint32_t node, std::span<const std::uint32_t> cache_pages,
                 std::span<const svm::PageId> references, std::string_view source);
/// From a file that is read to its end. Throws core::InternalError if that is no such thing.
PolicyRequest take_request(int descriptor);

}  // namespace dmpc::apps
