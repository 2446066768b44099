// What the command line makes of words, and says of those that it does not take.
#pragma once

#include <string>
#include <vector>

#include "apps/main/commands.h"
#include "apps/run/render_options.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/tables.h"

namespace dmpc::tests {

/// The message of the UsageError; empty if the words are taken.
inline std::string usage_complaint(const std::vector<std::string>& words) {
  return complaint_of<core::UsageError>([&] { apps::parse_command_line(words); });
}

/// What `dmpc render teapot-12 -o a.png` and more sets.
inline apps::RenderOptions typed_render(const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"render", "teapot-12", "-o", "a.png"};
  words.insert(words.end(), more.begin(), more.end());
  return apps::parse_command_line(words).options<apps::RenderOptions>();
}

/// The complaint about `dmpc render teapot-12 -o a.png` and more, on 6 nodes.
inline std::string render_usage_complaint(const std::vector<std::string>& more) {
  std::vector<std::string> words = {"render", "teapot-12", "--nodes=6", "-o", "a.png"};
  words.insert(words.end(), more.begin(), more.end());
  return usage_complaint(words);
}

/// What is typed behind dmpc, and a part of the complaint.
struct Refusal {
  std::string line, complaint;
};

/// The rows of a file of tests/, such as "render --nodes=0 => expected a whole number"; \n is the end of a line.
inline std::vector<Refusal> refusals_in(const std::string& file) {
  std::vector<Refusal> refusals;
  for (const auto& row : rows_in(file, 2)) {
    refusals.push_back({row[0], row[1]});
  }
  return refusals;
}

}  // namespace dmpc::tests
