// Long work that has nothing to do with other ranks, who are to know meanwhile that this one lives.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <future>
#include <span>

#include "core/base/usual_arithmetic.h"
#include "nodes/ranks/frame.h"
#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// What work() returns or throws. It runs on a thread of its own, while the calling one, which communicates, shows that it lives.
/// Others say nothing meanwhile. Throws LostRank as RankLinks do, when the work is done.
template <class Work>
auto with_life_signs(RankLinks& links, const Work& work) {
  constexpr std::chrono::milliseconds look{10};
  auto result = std::async(std::launch::async, [&work] {
    core::use_usual_arithmetic();
    return work();
  });
  while (result.wait_for(look) != std::future_status::ready) {
    while (links.take([](std::uint32_t, const ItemHeader&, std::span<const std::byte>) {})) {
    }
    links.look_after();
  }
  return result.get();
}

}  // namespace dmpc::nodes
