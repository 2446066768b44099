// A law of two parameters that the article's Table 3 follows closely: what a prediction has to beat.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/frontend/table/table.h"
#include "apps/lab/study/paper/catalogue.h"
#include "apps/lab/study/paper/data.h"

namespace dmpc::apps {

/// Node-seconds of N nodes: one_node * (1 + dearer * (N - 1) / N). (N - 1) / N is the share of references to pages that are at
/// home elsewhere: nothing but the dearer look-up of such pages is in it, no misses, no idle end.
struct PaperModel {
  double one_node = 0;  ///< seconds of one node
  double dearer = 0;

  double seconds(std::uint32_t node_count) const;
};

/// How many cells of a scene a law is fitted to: its smallest machines, as many as it has parameters.
inline constexpr std::size_t model_cell_count = 2;

/// Through the printed times of the scene's two smallest machines; nothing if it has but one.
std::optional<PaperModel> model_of(const PaperScene& scene);

/// What Table 3 prints, what our model predicts and what the law says: a row a cell that we predict and whose runs have ended. A
/// scene with one printed cell, which leaves nothing to predict, has a row that says so.
Table beside_model(const Catalogue& catalogue, const PaperResults& results);
/// How far both lie from what is printed: over all those cells, over those that neither was fitted to, and on the largest
/// machine.
Table against_model(const Catalogue& catalogue, const PaperResults& results);

}  // namespace dmpc::apps
