// This rank, as the tests that mpirun starts see it.
#pragma once

#include <cstdint>
#include <exception>
#include <vector>

#include "apps/frontend/ranks/mpi_library.h"
#include "apps/frontend/ranks/rank_group.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::tests {

/// All ranks run the same tests in the same order, on one fabric.
struct Here {
  apps::RankGroup& group;
  nodes::Fabric& fabric;

  std::uint32_t rank() const { return fabric.rank(); }
  std::uint32_t rank_count() const { return fabric.rank_count(); }

  /// Calls act(rank) for each other one.
  template <class Act>
  void for_others(const Act& act) const {
    for (std::uint32_t rank = 0; rank < rank_count(); ++rank) {
      if (rank != this->rank()) {
        act(rank);
      }
    }
  }

  /// Goes on when all have come here and nothing of what was sent before is under way any more: each rank's last frame before it
  /// is an empty one.
  void come_together() const {
    apps::mpi_library().exchange("");
    std::vector<bool> has_said(rank_count()), is_heard(rank_count());
    has_said[rank()] = is_heard[rank()] = true;
    const std::vector<bool> all(rank_count(), true);
    while (has_said != all || is_heard != all) {
      for_others([&](std::uint32_t rank) {
        if (!has_said[rank] && !fabric.room(rank).empty()) {
          fabric.send(rank, 0);
          has_said[rank] = true;
        }
      });
      if (const auto arrival = fabric.take()) {
        is_heard[arrival->rank] = is_heard[arrival->rank] || arrival->frame.empty();
      }
    }
    apps::mpi_library().exchange("");
  }
};

/// Made by main().
inline const Here* here_now = nullptr;

/// The error of a test that has lost a rank, and with it all later tests: main() goes on as a command would.
inline std::exception_ptr is_lost;

/// A test's view: nothing of the tests before is left on the way.
inline const Here& here() {
  here_now->come_together();
  return *here_now;
}

}  // namespace dmpc::tests
