#include "apps/lab/study/paper/law.h"

#include <string>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::apps {
namespace {

double share_elsewhere(std::uint32_t node_count) { return static_cast<double>(node_count - 1) / node_count; }

/// A cell that we predict, and the baseline model's value.
struct Comparison {
  TimedCell cell;
  double by_model = 0;  ///< efficiency in percent
  bool is_fitted_by_model = false;

  double our_difference() const { return *cell.efficiency - cell.printed_efficiency; }
  double difference_of_model() const { return by_model - cell.printed_efficiency; }
};

/// Every predicted cell is in a row with a base, so its scene has a model.
std::vector<Comparison> comparisons_of(const Catalogue& catalogue, const PaperResults& results) {
  std::vector<Comparison> comparisons;
  for (const TimedCell& cell : cells_of(catalogue.article, results)) {
    const PaperScene& scene = cell.scene();
    const std::optional<PaperModel> model = model_of(scene);
    if (cell.is_predicted() && model) {
      const std::uint32_t base_count = paper_node_counts[scene.base()];
      comparisons.push_back(
          {.cell = cell,
           .by_model = efficiency(model->seconds(base_count), base_count, model->seconds(cell.nodes()), cell.nodes()),
           .is_fitted_by_model = cell.nodes() <= paper_node_counts[scene.base() + model_cell_count - 1]});
    }
  }
  return comparisons;
}

/// Every scene has a base; two of the fitted cells are bases.
constexpr std::size_t predicted_cell_count = 17;

template <class Condition>
void add_summary(Table& table, const char* cells, const std::vector<Comparison>& comparisons, const Condition& is_meant) {
  Differences ours, of_model;
  for (const Comparison& comparison : comparisons) {
    if (is_meant(comparison)) {
      ours.add(comparison.our_difference());
      of_model.add(comparison.difference_of_model());
    }
  }
  if (ours.count > 0) {
    table.add_row({cells, std::uint64_t{ours.count}, ours.mean(), of_model.mean(), ours.worst, of_model.worst});
  }
}

}  // namespace

double PaperModel::seconds(std::uint32_t node_count) const {
  return one_node * (1 + dearer * share_elsewhere(node_count)) / node_count;
}

std::optional<PaperModel> model_of(const PaperScene& scene) {
  const std::size_t first = scene.base(), second = first + 1;
  if (second >= paper_node_counts.size()) {
    return std::nullopt;
  }
  const std::uint32_t fewer = paper_node_counts[first], more = paper_node_counts[second];
  const double at_fewer = static_cast<double>(scene.seconds[first]) * fewer;
  const double at_more = static_cast<double>(scene.seconds[second]) * more;
  // The model is a straight line in the share of references elsewhere.
  const double slope = (at_more - at_fewer) / (share_elsewhere(more) - share_elsewhere(fewer));
  const double one_node = at_fewer - slope * share_elsewhere(fewer);
  return PaperModel{.one_node = one_node, .dearer = slope / one_node};
}

Table against_model(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Efficiencies of Table 3 by our model and by a law of two parameters", {{"cells"},
                                                                                      {"number"},
                                                                                      {"our mean error", "points", 2},
                                                                                      {"the law's mean error", "points", 2},
                                                                                      {"our worst error", "points", 2},
                                                                                      {"the law's worst error", "points", 2}});
  const std::vector<Comparison> all = comparisons_of(catalogue, results);
  const auto on_64 = [](const Comparison& one) { return one.cell.nodes() == paper_node_counts.back(); };
  add_summary(table, "all that we predict", all, [](const Comparison&) { return true; });
  add_summary(table, "of them, those that the law was not fitted to", all,
              [](const auto& one) { return !one.is_fitted_by_model; });
  add_summary(table, "those of up to 32 nodes", all, [&](const Comparison& one) { return !on_64(one); });
  add_summary(table, "those of 64 nodes", all, on_64);
  if (all.size() < predicted_cell_count) {
    table.add_note("Unfinished: " + std::to_string(predicted_cell_count - all.size()) + " cells are missing.");
  }
  std::string laws;
  for (const PaperScene& scene : paper_scenes) {
    if (const auto model = model_of(scene)) {
      laws += std::string(laws.empty() ? "" : "; ") + scene.title + " " + fixed(model->one_node, 0) + " s and " +
              fixed(model->dearer, 3);
    }
  }
  table.add_note(
      "The law: N nodes take A (1 + c (N - 1) / N) node-seconds. A and c go through the two smallest printed machines "
      "of each scene, eight cells of four scenes: " +
      laws + "; our prices were fitted to four cells of two.");
  return table;
}

}  // namespace dmpc::apps
