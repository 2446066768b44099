// A baseline model of two parameters that the article's Table 3 follows closely; a prediction has to beat it.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/frontend/table/table.h"
#include "apps/lab/study/paper/catalogue.h"
#include "apps/lab/study/paper/data.h"

namespace dmpc::apps {

/// Node-seconds of N nodes: one_node * (1 + dearer * (N - 1) / N). (N - 1) / N is the share of references to pages whose home is
/// another node: the model has only the dearer look-up of such pages, no misses and no idle end.
struct PaperModel {
  double one_node = 0;  ///< seconds of one node
  double dearer = 0;

  double seconds(std::uint32_t node_count) const;
};

/// Number of cells of a scene to which the model is fitted: its smallest machines, one for each parameter.
inline constexpr std::size_t model_cell_count = 2;

/// Fits the printed times of the scene's two smallest machines; returns nothing if it has only one.
std::optional<PaperModel> model_of(const PaperScene& scene);

/// Returns the errors of our efficiencies and the baseline model's against the printed ones: over all cells that we predict, over
/// those to which neither was fitted, and on the largest machine.
Table against_model(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
