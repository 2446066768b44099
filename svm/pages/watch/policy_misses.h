// The page misses of a replacement policy, from the references alone.
#pragma once

#include <cstdint>
#include <span>

#include "svm/pages/page.h"
#include "svm/pages/replacement.h"

namespace dmpc::svm {

/// What a node's cache of `cache_pages` frames would miss, if each page came before the next reference; with none every reference
/// is a miss. `seed` is the node's number. Takes a cache's memory, its pages of one byte, and for each reference about what a
/// cache takes. Throws core::RoomError if there is not so much.
std::uint64_t policy_misses(Replacement replacement, std::span<const PageId> references, std::uint32_t cache_pages,
                            std::uint32_t seed);

}  // namespace dmpc::svm
