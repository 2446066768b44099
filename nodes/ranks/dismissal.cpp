#include "nodes/ranks/dismissal.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <thread>

#include "nodes/ranks/exchange.h"
#include "nodes/ranks/frame.h"

namespace dmpc::nodes {

void dismiss(RankLinks& links, int status) {
  links.say_to_all(Item::dismissal, bytes_of(status));
  Exchange(links).turn_until([&] { return links.has_said_all(); },
                             [](std::uint32_t, const ItemHeader&, std::span<const std::byte>) {});
}

int wait_for_dismissal(RankLinks& links) {
  std::optional<int> status;
  Exchange(links).turn_until([&] { return status.has_value(); },
                             [&](std::uint32_t, const ItemHeader& header, std::span<const std::byte> bytes) {
                               if (header.item == Item::dismissal) {
                                 status = value_of<int>(bytes);
                               }
                             });
  return *status;
}

void let_rank_0_speak() { std::this_thread::sleep_for(std::chrono::seconds(1)); }

}  // namespace dmpc::nodes
