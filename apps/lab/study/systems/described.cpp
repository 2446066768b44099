// The table "described": every system as it was when it was described, and the verdicts that its authors drew.
#include <algorithm>
#include <array>

#include "apps/lab/study/systems/runner.h"

namespace dmpc::apps {
namespace {

/// The first system takes less time than the second.
struct AuthorsClaim {
  System first, second;
  const char* text;
};

constexpr std::array<AuthorsClaim, 3> authors_claims = {
    {{System::subsampled, System::equal_size, "regions by a small picture are faster than regions of equal size"},
     {System::svm, System::subsampled, "pages that travel are faster than rays that travel"},
     {System::replicated, System::replicated_extents, "a subdivision of space takes less time than a tree of extents"}}};

/// Leaves out what only one strategy has: the authors compared one with all that belongs to it with the other.
void keep_options_of_both(ComparedRow& first, ComparedRow& second) {
  const auto keep = [](ComparedRow& row, const ComparedRow& other) {
    std::erase_if(row.options, [&](const auto& option) { return !other.options.contains(option.first); });
  };
  keep(first, second);
  keep(second, first);
}

const char* word_of(Outcome outcome) {
  return outcome == Outcome::tie ? "a tie" : outcome == Outcome::faster ? "held" : "not held";
}

}  // namespace

void describe(SystemRunner& runner) {
  for (const std::uint32_t node_count : runner.study().node_counts) {
    std::vector<SystemSetup> setups;
    for (const System system : runner.study().chosen) {
      SystemSetup setup = described_setup(system);
      setup.options.computer.node_count = node_count;
      give_whole_cache(setup, runner.database(setup.asked).page_count());
      setups.push_back(std::move(setup));
    }
    const std::vector<TimedSetup> timed = runner.time(setups);
    for (std::size_t i = 0; i < setups.size(); ++i) {
      runner.add_row(name_of(SystemTable::described), "as needed", setups[i], timed[i], std::nullopt);
    }
    const auto row_of_system = [&](System system) -> std::optional<ComparedRow> {
      const auto found = std::find_if(setups.begin(), setups.end(), [&](const SystemSetup& one) { return one.system == system; });
      const auto i = static_cast<std::size_t>(found - setups.begin());
      return i < setups.size() && timed[i].run ? std::optional(runner.compared(*found, *timed[i].run, "")) : std::nullopt;
    };
    for (const AuthorsClaim& claim : authors_claims) {
      std::optional<ComparedRow> first = row_of_system(claim.first), second = row_of_system(claim.second);
      if (first && second) {
        if (first->options["strategy"] != second->options["strategy"]) {
          keep_options_of_both(*first, *second);
        }
        const std::string said = std::string("Badouel, Bouatouch and Priol (1994): ") + claim.text + ": ";
        if (IsolatedVerdict::may_compare(*first, *second)) {
          const IsolatedVerdict verdict(*first, *second);
          runner.note(said + word_of(verdict.outcome()) + ". " + verdict.sentence());
        } else {
          runner.note(said + "not judged, since the structures have prices of their own.");
        }
      }
    }
  }
}

}  // namespace dmpc::apps
