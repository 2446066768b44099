// The table "equal": every system on every structure at its best with the same memory, and what may be concluded from it.
#include <algorithm>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/systems/price_draws.h"
#include "apps/lab/study/systems/runner.h"
#include "apps/lab/study/systems/too_small.h"

namespace dmpc::apps {
namespace {

/// A row whose options are searched.
struct Candidate {
  SystemSetup start;
  Search search;
  TimedSetup best = {};

  SystemSetup setup() const { return with_setting(start, search.options(), search.best()); }
  double seconds() const { return best.run->seconds; }
  Strategy strategy() const { return start.options.strategy; }
};

/// The rows with the same number of nodes and the same memory.
struct ComparisonCell {
  std::uint32_t node_count;
  const MemoryRule* memory;
  std::size_t memory_bytes;
  std::vector<Candidate> candidates;

  std::string text() const {
    return counted(node_count, "node") + ", memory " + memory->text() + " (" + bytes_text(memory_bytes) + ")";
  }
};

/// Returns what the better of two systems with rays needs on the grid by default.
std::size_t memory_of_rays(SystemRunner& runner, std::uint32_t node_count) {
  std::vector<SystemSetup> setups;
  for (const System system : {System::scattered, System::subsampled}) {
    setups.push_back({system, {}, strategy_of(system)});
    setups.back().options.computer.node_count = node_count;
  }
  const std::vector<TimedSetup> timed = runner.time(setups);
  const auto seconds = [](const TimedSetup& one) { return one.run ? one.run->seconds : 1e300; };
  const TimedSetup& better = seconds(timed[1]) < seconds(timed[0]) ? timed[1] : timed[0];
  if (!better.run) {
    throw core::CapacityError(better.misfit);
  }
  return better.run->memory_bytes;
}

ComparisonCell cell_of(const SystemsStudy& study, std::uint32_t node_count, const MemoryRule& memory, std::size_t memory_bytes) {
  ComparisonCell cell{node_count, &memory, memory_bytes, {}};
  for (SystemSetup& setup : setups_on_all_structures(study.chosen)) {
    setup.options.computer.node_count = node_count;
    setup.options.computer.node_memory_bytes = memory_bytes;
    std::vector<SearchedOption> options = searched_options(setup);
    cell.candidates.push_back({std::move(setup), Search(std::move(options))});
  }
  return cell;
}

/// Carries out one step of all searches; returns whether there was any.
bool search_on(SystemRunner& runner, std::vector<ComparisonCell>& cells) {
  std::vector<SystemSetup> setups;
  for (const ComparisonCell& cell : cells) {
    for (const Candidate& candidate : cell.candidates) {
      for (const Search::Setting& setting : candidate.search.wanted()) {
        setups.push_back(with_setting(candidate.start, candidate.search.options(), setting));
      }
    }
  }
  std::vector<TimedSetup> timed = runner.time(setups);
  auto next = timed.begin();
  for (ComparisonCell& cell : cells) {
    for (Candidate& candidate : cell.candidates) {
      std::vector<std::optional<double>> seconds;
      for (std::size_t i = 0; i < candidate.search.wanted().size(); ++i, ++next) {
        seconds.push_back(next->run ? std::optional(next->run->seconds) : std::nullopt);
        if (next->run && (!candidate.best.run || next->run->seconds < candidate.seconds())) {
          candidate.best = std::move(*next);
        }
      }
      candidate.search.take(seconds);
    }
  }
  return !setups.empty();
}

/// The fastest row of each strategy, the fastest of all first.
std::vector<const Candidate*> best_of_strategies(const ComparisonCell& cell) {
  std::vector<const Candidate*> best;
  for (const Candidate& candidate : cell.candidates) {
    if (!candidate.best.run) {
      continue;
    }
    const auto rival =
        std::find_if(best.begin(), best.end(), [&](const Candidate* one) { return one->strategy() == candidate.strategy(); });
    if (rival == best.end()) {
      best.push_back(&candidate);
    } else if (candidate.seconds() < (*rival)->seconds()) {
      *rival = &candidate;
    }
  }
  std::stable_sort(best.begin(), best.end(), [](const Candidate* a, const Candidate* b) { return a->seconds() < b->seconds(); });
  return best;
}

/// Times the best rows with drawn prices, three at most: by draw and row.
std::vector<std::vector<double>> draws_of(SystemRunner& runner, const std::vector<const Candidate*>& best) {
  constexpr std::size_t drawn_max = 3;
  std::vector<SystemSetup> setups;
  for (std::size_t i = 0; i < std::min(best.size(), drawn_max); ++i) {
    setups.push_back(best[i]->setup());
  }
  return setups.size() < 2 ? std::vector<std::vector<double>>() : runner.time_draws(setups);
}

/// Pairs that differ in one option: the winner's structure, and whatever defines two systems.
void add_isolated(SystemRunner& runner, const ComparisonCell& cell, const Candidate& winner) {
  const auto& all = cell.candidates;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const bool is_one_system = all[i].start.system == all[j].start.system;
      const bool is_about_winner = &all[i] == &winner || &all[j] == &winner;
      if (!all[i].best.run || !all[j].best.run || (is_one_system && !is_about_winner)) {
        continue;
      }
      const ComparedRow first = runner.compared(all[i].setup(), *all[i].best.run, search_text());
      const ComparedRow second = runner.compared(all[j].setup(), *all[j].best.run, search_text());
      if (IsolatedVerdict::may_compare(first, second)) {
        runner.note(IsolatedVerdict(first, second).sentence());
      }
    }
  }
}

void add_verdicts(SystemRunner& runner, const ComparisonCell& cell, const std::vector<const Candidate*>& best,
                  const std::vector<std::vector<double>>& draws) {
  const ComparedRow winner = runner.compared(best[0]->setup(), *best[0]->best.run, search_text());
  for (std::size_t other = 1; other < best.size(); ++other) {
    const bool is_drawn = !draws.empty() && other < draws[0].size();
    const BestVerdict verdict(winner, runner.compared(best[other]->setup(), *best[other]->best.run, search_text()),
                              is_drawn ? std::optional(ahead_in(draws, 0, other)) : std::nullopt);
    runner.note(verdict.sentence());
  }
  add_isolated(runner, cell, *best[0]);
}

/// Adds the rows and the verdicts of a cell.
void finish(SystemRunner& runner, const ComparisonCell& cell) {
  const std::vector<const Candidate*> best = best_of_strategies(cell);
  const std::string small = best.empty() ? "" : too_small(best[0]->best.run->shares, runner.picture());
  const std::vector<std::vector<double>> draws = small.empty() ? draws_of(runner, best) : std::vector<std::vector<double>>();
  const std::vector<std::uint32_t> first = first_in(draws);
  for (const Candidate& candidate : cell.candidates) {
    const auto place = static_cast<std::size_t>(std::find(best.begin(), best.end(), &candidate) - best.begin());
    runner.add_row(name_of(SystemTable::equal), cell.memory->text(), candidate.setup(), candidate.best,
                   place < first.size() ? std::optional(first[place]) : std::nullopt);
  }
  if (runner.study().has_search) {
    for (const Candidate& candidate : cell.candidates) {
      runner.note("Search, " + cell.text() + ", " + candidate.start.name() + ": " + candidate.search.steps_text() + ".");
    }
  }
  if (best.empty()) {
    runner.note("On " + cell.text() + " nothing fits.");
  } else if (!small.empty()) {
    runner.note("Too small, " + cell.text() + ": with " + best[0]->setup().name() + " " + small + ". No verdict.");
  } else {
    add_verdicts(runner, cell, best, draws);
  }
}

}  // namespace

void compare_at_equal_memory(SystemRunner& runner) {
  const SystemsStudy& study = runner.study();
  std::vector<ComparisonCell> cells;
  for (const std::uint32_t node_count : study.node_counts) {
    const bool has_rays = std::any_of(study.memories.begin(), study.memories.end(),
                                      [](const MemoryRule& rule) { return !rule.share && !rule.bytes; });
    const std::size_t rays_bytes = has_rays ? memory_of_rays(runner, node_count) : 0;
    const std::size_t database_bytes = runner.database({}).bytes().size();
    for (const MemoryRule& memory : study.memories) {
      cells.push_back(cell_of(study, node_count, memory, memory.bytes_of(database_bytes, rays_bytes)));
    }
  }
  while (search_on(runner, cells)) {
  }
  for (const ComparisonCell& cell : cells) {
    finish(runner, cell);
  }
}

}  // namespace dmpc::apps
