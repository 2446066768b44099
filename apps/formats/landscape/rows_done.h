// How far the making of a landscape is.
#pragma once

#include <cstdint>
#include <functional>

namespace dmpc::apps {

/// Is told from the calling thread, now and then, how many rows of so many are done: of the ground, then of its picture. May be
/// empty.
using RowsDone = std::function<void(std::uint64_t done, std::uint64_t total)>;

}  // namespace dmpc::apps
