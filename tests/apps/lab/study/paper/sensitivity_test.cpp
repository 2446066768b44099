#include "apps/lab/study/paper/sensitivity.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <variant>

#include "core/trace/charge.h"
#include "tests/support/paper_results.h"

namespace dmpc::tests::sensitivity_test {

using namespace apps;

namespace {

const Variation& find(const std::vector<Variation>& variations, const std::string& figure, const std::string& change) {
  const auto found = std::find_if(variations.begin(), variations.end(),
                                  [&](const Variation& one) { return one.figure == figure && one.change == change; });
  REQUIRE(found != variations.end());
  return *found;
}

/// All of a machine that has a price.
std::vector<std::uint64_t> figures_of(const nodes::Machine& machine) {
  std::vector<std::uint64_t> figures(machine.cost_ps.begin(), machine.cost_ps.end());
  for (const nodes::MessageCost& cost : {machine.short_message, machine.long_message}) {
    figures.insert(figures.end(), {cost.send_ns, cost.latency_ns, cost.receive_ns, cost.byte_ps});
  }
  figures.insert(figures.end(), {machine.hop_ns, machine.service_ns, std::uint64_t{machine.has_contention}});
  return figures;
}

std::size_t changed_count(const nodes::Machine& a, const nodes::Machine& b) {
  const std::vector<std::uint64_t> before = figures_of(a), after = figures_of(b);
  std::size_t count = 0;
  for (std::size_t figure = 0; figure < before.size(); ++figure) {
    count += before[figure] == after[figure] ? 0 : 1;
  }
  return count;
}

/// As printed, whatever the variation.
PaperResults unchanged(const Catalogue& catalogue, const std::vector<VariedRuns>& varied) {
  PaperResults results = as_printed(catalogue);
  for (const VariedRuns& runs : varied) {
    for (const auto [scene, column] : watched_cells) {
      for (const std::size_t at : {paper_scenes[scene].base(), column}) {
        results[runs.timed[scene][at]] = result_of_seconds(paper_scenes[scene].seconds[at]);
      }
    }
  }
  return results;
}

}  // namespace

TEST_CASE("every figure is made a fifth less and more, and nothing else is changed") {
  const nodes::Machine machine = paper_machine();
  const std::vector<Variation> variations = variations_of(machine);
  CHECK(variations.size() == 32);
  for (const Variation& variation : variations) {
    CAPTURE(variation.figure);
    const bool is_of_both_classes = variation.figure == "a byte" || variation.figure.find(" overhead") != std::string::npos;
    const std::size_t all_prices = core::charge_names.size() - 1;  // a home look-up is free
    CHECK(changed_count(machine, variation.machine) == (variation.figure == "all operations" ? all_prices
                                                        : is_of_both_classes                 ? 2
                                                                                             : 1));
  }
  CHECK(find(variations, "interrupt service", "-20 %").machine.service_ns == machine.service_ns * 4 / 5);
  CHECK(find(variations, "long message latency", "+20 %").machine.long_message.latency_ns ==
        machine.long_message.latency_ns * 6 / 5);
  CHECK_FALSE(find(variations, "contention for links", "off").machine.has_contention);
}

TEST_CASE("a home look-up, which is free, gets a fifth of a cached one's price, and its row says so") {
  const nodes::Machine machine = paper_machine();
  const auto price = [](const nodes::Machine& of, core::Charge charge) { return of.cost_ps[static_cast<std::size_t>(charge)]; };
  const Variation dearer = find(variations_of(machine), "home look-up", "a fifth of a cached one's");
  CHECK(price(machine, core::Charge::home_lookup) == 0);
  CHECK(price(dearer.machine, core::Charge::home_lookup) == price(machine, core::Charge::cached_lookup) / 5);
}

TEST_CASE("no two variations are the same machine") {
  std::set<std::vector<std::uint64_t>> machines;
  const std::vector<Variation> variations = variations_of(paper_machine());
  for (const Variation& variation : variations) {
    machines.insert(figures_of(variation.machine));
  }
  CHECK(machines.size() == variations.size());
}

TEST_CASE("a variation renders the watched cells and what they are held against, at the catalogue's settings") {
  Catalogue catalogue = catalogue_of(16);
  const std::size_t before = catalogue.runs.size();
  const std::vector<VariedRuns> varied = add_variations(catalogue);
  CHECK(catalogue.runs.size() == before + 8 * varied.size());
  for (const VariedRuns& runs : varied) {
    for (const auto [scene, column] : watched_cells) {
      const PaperRun& run = catalogue.runs[runs.timed[scene][column]];
      CHECK(run.scene == paper_scenes[scene].scene);
      CHECK(run.node_count == paper_node_counts[column]);
      CHECK(run.node_memory_bytes == catalogue.runs[catalogue.grid.timed[scene][column]].node_memory_bytes);
      CHECK(figures_of(run.machine) == figures_of(runs.variation.machine));
      CHECK(catalogue.runs[runs.timed[scene][paper_scenes[scene].base()]].node_count ==
            paper_node_counts[paper_scenes[scene].base()]);
    }
  }
}

TEST_CASE("what changes nothing has rows of zeros, and what doubles one time halves one efficiency") {
  Catalogue catalogue = catalogue_of(16);
  const std::vector<VariedRuns> varied = add_variations(catalogue);
  PaperResults results = unchanged(catalogue, varied);
  results[varied[1].timed[1][6]]->total_ns *= 2;  // Mountain on 64 nodes: 87.05 % before
  const Table table = sensitivity(catalogue, results, varied);
  REQUIRE(table.rows().size() == varied.size());
  for (std::size_t row = 0; row < varied.size(); ++row) {
    for (std::size_t column = 3; column < table.columns().size(); ++column) {
      const double expected = row != 1 ? 0 : column == 4 ? -43.525 : column == 8 ? 8.705 : column == 9 ? 43.525 : 0;
      CHECK(std::get<double>(table.rows()[row][column]) == doctest::Approx(expected).epsilon(1e-3));
    }
  }
}

TEST_CASE("variations whose runs are missing are left out, and the table says how many") {
  Catalogue catalogue = catalogue_of(16);
  const std::vector<VariedRuns> varied = add_variations(catalogue);
  PaperResults results = unchanged(catalogue, varied);
  results[varied.back().timed[3][6]].reset();
  const Table table = sensitivity(catalogue, results, varied);
  CHECK(table.rows().size() == varied.size() - 1);
  CHECK(table.notes().back() == "Unfinished: 1 of 32 rows are missing.");
  results[catalogue.grid.timed[1][0]].reset();  // what all are held against
  CHECK(sensitivity(catalogue, results, varied).rows().empty());
}

}  // namespace dmpc::tests::sensitivity_test
