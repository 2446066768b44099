// A grid so fine that a small scene has several macro cells.
#pragma once

#include <cstddef>

#include "core/database/database.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// There is one macro cell for some 4,096 primitives, so a smaller scene would have a single one, and no traversal would go from
/// one to another. With as many cells as primitives it has several, from about 500 primitives on; larger scenes have several
/// anyway and keep their grid.
inline core::BuildOptions several_macro_cells(const core::Scene& scene) {
  constexpr std::size_t many = 4096;
  core::BuildOptions options;
  if (scene.objects.size() < many) {
    options.cells_per_primitive = 1;
  }
  return options;
}

}  // namespace dmpc::apps
