// The data of one finished render.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/picture/layer_image.h"
#include "apps/run/render_options.h"
#include "apps/run/report.h"
#include "core/database/database.h"
#include "nodes/observers/heat_map.h"

namespace dmpc::nodes {
struct Trace;
}
namespace dmpc::svm {
class ReferenceLog;
}

namespace dmpc::apps {

struct RunView;

/// Wall-clock seconds by phase, and processor seconds.
struct Seconds {
  double load = 0, build = 0, prepare = 0, render = 0, write = 0;
  double user = 0, system = 0;                ///< of the whole process so far
  double render_user = 0, render_system = 0;  ///< of the phase `render` alone
};

struct RenderRecord {
  const RenderOptions& options;
  const core::Database& database;
  const Report& report;
  Seconds seconds;
  const nodes::HeatMap* heat = nullptr;                        ///< for options.heat_maps and options.report
  const std::vector<LayerImage>* layers = nullptr;             ///< for options.layers
  const nodes::Trace* trace = nullptr;                         ///< for options.trace
  const RunView* view = nullptr;                               ///< for options.report
  const std::vector<svm::ReferenceLog>* references = nullptr;  ///< for options.references
  std::uint64_t samples_found_done = 0;                        ///< sum over all pixels of the resumed checkpoint
  std::optional<std::uint64_t> scene_digest = {};              ///< for options.report
  std::optional<std::uint64_t> copied_frame = {};              ///< it is a copy of this frame's picture; all counters are 0
  mutable std::optional<std::uint64_t> found_film_hash = {};   ///< once somebody has asked

  /// The hash of the film, which takes some 20 ns a pixel: only if it is asked for.
  std::uint64_t film_hash() const {
    if (!found_film_hash) {
      found_film_hash = account_of(report).film.hash();
    }
    return *found_film_hash;
  }
};

/// Returns a description such as "svm, 8 nodes of ipsc2".
inline std::string computer_text(const RenderRecord& record) {
  const RenderOptions& options = record.options;
  const std::string on_machine = options.computer.machine ? " of " + options.computer.machine->name : "";
  return std::string(name_of(options.strategy)) + ", " + counted(options.computer.node_count, "node") + on_machine;
}

}  // namespace dmpc::apps
