// The numbers of one heat map, and what they mean.
#pragma once

#include <string>
#include <vector>

#include "apps/run/render_record.h"
#include "core/picture/heat_kind.h"
#include "nodes/observers/heat_map.h"

namespace dmpc::apps {

/// What is counted, and its unit: "rays", "us".
struct HeatMeaning {
  const char* text;
  const char* unit;
};
HeatMeaning meaning_of(core::HeatKind kind, Strategy strategy);

/// A number for each pixel, row by row from the top left.
struct HeatField {
  core::HeatKind kind;
  int width = 0, height = 0;
  std::vector<double> values;
  std::string meaning;  ///< what the numbers count, in words
  std::string unit;     ///< unit of the numbers: "rays", "us"
  std::string clock;  ///< clock of `time`: "processor time" or "virtual time", of `done` also "wall clock"; empty for other kinds
  bool is_repeatable = false;  ///< another run with the same options gives the same bits

  double least() const;
  double largest() const;
  double sum() const;
};

/// Returns the field of a run that has filled its heat map. Requires record.heat with this kind.
///
/// These kinds are repeatable: rays, depth and samples, which are also the same for every strategy and number of nodes;
/// references and pages, which are the same for every number of nodes; everything in virtual time; with threads, faults and node
/// if there is one node, or if no pixel changes its node and (faults) each node has one pixel in flight at a time; and dataflow's
/// node.
HeatField heat_field(core::HeatKind kind, const RenderRecord& record);

}  // namespace dmpc::apps
