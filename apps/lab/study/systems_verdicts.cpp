// The expectations of the systems, written down before the first comparison, and their verdicts from a table.
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/studies.h"

namespace dmpc::apps {
namespace {

/// The rows of the same structures, number of nodes and rule of memory that have figures.
struct Round {
  std::string structures;
  double node_count;
  std::string memory;
  struct Entry {
    System system;
    double seconds;
  };
  std::vector<Entry> entries;

  bool is_of(const std::string& its_structures, double its_node_count, const std::string& its_memory) const {
    return structures == its_structures && node_count == its_node_count && memory == its_memory;
  }

  /// Returns the fastest of those; nullptr if there is none.
  const Entry* fastest(const std::function<bool(System)>& is_meant) const {
    const Entry* best = nullptr;
    for (const Entry& entry : entries) {
      best = is_meant(entry.system) && (best == nullptr || entry.seconds < best->seconds) ? &entry : best;
    }
    return best;
  }
};

std::vector<Round> rounds_of(const Table& table) {
  std::vector<Round> rounds;
  for (const std::vector<Cell>& row : table.rows()) {
    const double node_count = *number_in(table, row, "nodes");
    const auto& structures = std::get<std::string>(row[0]);
    const auto& memory = std::get<std::string>(row[2]);
    if (rounds.empty() || !rounds.back().is_of(structures, node_count, memory)) {
      rounds.push_back({structures, node_count, memory, {}});
    }
    if (const auto seconds = number_in(table, row, "virtual time")) {
      rounds.back().entries.push_back({find_system(std::get<std::string>(row[1])), *seconds});
    }
  }
  return rounds;
}

/// Expects the fastest of `first` to be faster than the fastest of `others`.
struct Expectation {
  const char* text;
  bool (*is_for)(const Round&);
  bool (*is_first)(System);
  bool (*is_other)(System);
};

bool is_ample(const Round& round) { return round.memory == "auto"; }
bool is_any(const Round&) { return true; }
bool is_scarce(const Round& round) { return round.memory == "5%" || round.memory == "1%"; }
bool is_copy_in_space(System system) { return system == System::replicated; }
bool is_copy_in_extents(System system) { return system == System::replicated_extents; }
bool is_replicated(System system) { return system == System::replicated || system == System::replicated_extents; }
bool is_distributed(System system) { return !is_replicated(system); }
bool fetches_pages(System system) { return strategy_of(system).strategy == Strategy::svm; }
bool fetches_no_pages(System system) { return is_distributed(system) && !fetches_pages(system); }
/// The two systems differ only in the homes of pages.
bool has_host_home(System system) { return system == System::green_paddon; }
bool has_spread_homes_else_alike(System system) { return system == System::svm_resident; }
bool asks(System system) { return system == System::forest || system == System::forest_static; }
bool is_subsampled(System system) { return system == System::subsampled; }
bool is_equal_size(System system) { return system == System::equal_size; }
bool is_moving(System system) { return system == System::moving; }

constexpr std::array<Expectation, 7> expectations = {
    {{"a tree of extents takes more time than a subdivision of space, as the article says", is_ample, is_copy_in_space,
      is_copy_in_extents},
     {"whole copies are the fastest, where memory allows them", is_ample, is_replicated, is_distributed},
     {"with ample memory pages are the fastest of what travels", is_ample, fetches_pages, fetches_no_pages},
     {"with 1 to 5 % of the database beside its part a node does better by questions than by pages", is_scarce, asks,
      fetches_pages},
     {"whatever the memory, with all else equal the host is a slower home than all nodes together", is_any,
      has_spread_homes_else_alike, has_host_home},
     {"regions by a subsampled picture are faster than regions of equal size", is_ample, is_subsampled, is_equal_size},
     {"where hits crowd, regions that move while rays travel are faster than those that stay", is_ample, is_moving,
      is_subsampled}}};

/// Times that differ by no more than this share count as equal.
constexpr double tie_share = 0.01;

const char* verdict_of(double first, double other) {
  return std::abs(first - other) <= tie_share * other ? "A tie" : first < other ? "Held" : "Not held";
}

std::string time_text(const Round::Entry& entry) {
  return std::string(name_of(entry.system)) + " " + rounded(entry.seconds) + " s";
}

}  // namespace

std::vector<std::string> verdicts_of(const Table& table) {
  std::vector<std::string> verdicts;
  const std::vector<Round> rounds = rounds_of(table);
  for (const Expectation& expectation : expectations) {
    for (const Round& round : rounds) {
      const Round::Entry* const first = round.fastest(expectation.is_first);
      const Round::Entry* const other = round.fastest(expectation.is_other);
      if (expectation.is_for(round) && first != nullptr && other != nullptr) {
        verdicts.push_back("Expected: " + std::string(expectation.text) + ". " + verdict_of(first->seconds, other->seconds) +
                           " on " + counted(static_cast<std::uint64_t>(round.node_count), "node") + ", memory " + round.memory +
                           ", structures " + round.structures + ": " + time_text(*first) + ", " + time_text(*other) + ".");
      }
    }
  }
  return verdicts;
}

}  // namespace dmpc::apps
