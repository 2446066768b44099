// A scene as every kernel wants it, and the referee over it.
#pragma once

#include "apps/lab/bench/stability/cells.h"
#include "apps/lab/oracle/referee.h"
#include "apps/oracle/oracle.h"
#include "core/database/database.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// Immutable once made, so any thread may trace in it.
struct StabilitySubject {
  explicit StabilitySubject(const core::Scene& scene) : StabilitySubject(scene, several_top_cells(scene)) {}
  StabilitySubject(const core::Scene& scene, const core::BuildOptions& options)
      : database(core::build_database(scene, options)), voxels(core::build_database(scene, with_voxels(options))) {}

  static core::BuildOptions with_voxels(core::BuildOptions options) {
    options.structure = core::Structure::voxels;
    return options;
  }

  core::Database database;
  core::Database voxels;  ///< of the same floats
  EmbreeScene embree_fast{database.primitives(), EmbreeMode::fast};
  EmbreeScene embree_robust{database.primitives(), EmbreeMode::robust};
  Referee referee{database};

  const core::GridFrame& frame() const { return database.header().frame; }
};

}  // namespace dmpc::apps
