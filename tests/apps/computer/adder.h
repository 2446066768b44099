// A program of tasks that add entries of a table, well or badly, and what came of a run of it.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/computer/dmpc/pages.h"
#include "tests/apps/computer/ran.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests {

using Lines = std::vector<std::string>;

enum class Misdeed : std::uint8_t { none, looks_between, looks_beyond, waits_for_nothing, charges_what_is_not_declared };

inline constexpr std::uint32_t table_size = 4000, additions_a_task = 20, adders = 50;

/// Adds entries of a table from all over it, one a step.
class Adder {
 public:
  Adder(std::uint32_t number, Misdeed misdeed) : number_(number), misdeed_(misdeed) {}

  Step run(Pages& pages) {
    if (misdeed_ == Misdeed::looks_between || misdeed_ == Misdeed::looks_beyond) {
      (void)pages.find(misdeed_ == Misdeed::looks_between ? 4 : std::uint64_t{1} << 24U);
    }
    std::uint32_t entry = 0;
    if (!pages.read(sizeof(entry) * ((number_ * 977 + added_ * 1409) % table_size), entry)) {
      return Step::absent;
    }
    if (misdeed_ == Misdeed::waits_for_nothing) {
      return Step::absent;
    }
    pages.charge(misdeed_ == Misdeed::charges_what_is_not_declared ? 1 : 0);
    sum_ += entry;
    return ++added_ == additions_a_task ? Step::finished : Step::more;
  }
  std::uint64_t result() const { return sum_; }

 private:
  std::uint32_t number_, added_ = 0;
  Misdeed misdeed_;
  std::uint64_t sum_ = 0;
};

/// So that a result in another's place is found.
inline std::uint64_t folded(std::uint64_t sum, std::uint64_t result) { return 31 * sum + result; }

/// What all of them come to if entry i is i.
inline std::uint64_t expected_sum() {
  std::uint64_t sum = 0;
  for (std::uint32_t number = 0; number < adders; ++number) {
    std::uint64_t of_task = 0;
    for (std::uint32_t added = 0; added < additions_a_task; ++added) {
      of_task += (number * 977 + added * 1409) % table_size;
    }
    sum = folded(sum, of_task);
  }
  return sum;
}

inline PagedApplication adding(std::uint32_t runs = 1, Misdeed misdeed = Misdeed::none, double nanoseconds = 10) {
  return {.description = "Add entries of a table",
          .operations = {{"addition", nanoseconds}},
          .act = [runs, misdeed](PagedComputer& computer) {
            std::vector<std::uint32_t> table(table_size);
            for (std::uint32_t i = 0; i < table_size; ++i) {
              table[i] = i;
            }
            std::uint64_t sum = 0;
            for (std::uint32_t run = 0; run < runs; ++run) {
              for (const std::uint64_t result : computer.run(std::span<const std::uint32_t>(table), adders,
                                                             [=](std::uint32_t number) { return Adder(number, misdeed); })) {
                sum = folded(sum, result);
              }
            }
            return "sum " + std::to_string(sum);
          }};
}

inline Ran run_adding(const PagedApplication& application, const Lines& words) {
  return ran("adder", words, [&](int count, const char* const* all) { return run_tasks(count, all, application); });
}

inline nlohmann::json adding_stats(const PagedApplication& application, Lines words) {
  const TemporaryFolder folder;
  words.push_back("--stats=" + (folder / "stats.json").string());
  const Ran done = run_adding(application, words);
  REQUIRE_MESSAGE(done.status == 0, done.errors);
  return nlohmann::json::parse(file_text(folder / "stats.json"));
}

}  // namespace dmpc::tests
