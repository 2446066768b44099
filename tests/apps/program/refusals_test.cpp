// Lines that are refused before anything is done, and what is said of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "apps/frontend/line/words.h"
#include "apps/main/commands.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::tests::refusals_test {

namespace {

using Words = std::vector<std::string>;

/// What a row leaves out: the scene and the picture.
const Refusal beginnings[] = {{"render", "render teapot-12 -o a.png"},
                              {"mesh", "render a.glb -o a.png"},
                              {"paths", "render teapot-12 -o a.png --transport=paths"},
                              {"dataflow", "render teapot-12 -o a.png --strategy=dataflow"},
                              {"virtual", "render teapot-12 -o a.png --runner=virtual"}};

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The line of a row, with all that it leaves out.
std::string whole_line(const std::string& line) {
  for (const Refusal& beginning : beginnings) {
    if (line.starts_with(beginning.line + " ")) {
      return with(line, beginning.line, beginning.complaint);
    }
  }
  return line;
}

void check_refused(const Words& line, const std::string& expected) {
  const std::string complaint = usage_complaint(line);
  CAPTURE(line.back());
  CHECK_MESSAGE(contains(complaint, expected), complaint);
  CHECK_MESSAGE((contains(complaint, "\nTry: dmpc") && complaint.ends_with("--help")), complaint);
}

void check_refused(const Refusal& row) {
  Words line = apps::words_between(whole_line(row.line), ' ');
  const std::string last = line.back(), option = last.substr(0, last.find('=') + 1);
  CAPTURE(row.line);
  for (std::string value : apps::words_between(last.substr(option.size()), '|')) {
    std::replace(value.begin(), value.end(), '~', ' ');
    line.back() = option + value;
    check_refused(line, with(row.complaint, "{}", value));
  }
}

}  // namespace

TEST_CASE("what an option does not take, what does not go together, or is nothing that there is, is named, with what there is") {
  for (const Refusal& row : refusals_in("apps/program/refusals.txt")) {
    check_refused(row);
  }
  CHECK(contains(usage_complaint({"render", "teapot-12"}), "Try: dmpc render --help"));
  CHECK(contains(usage_complaint({"render", "-o", "a.png"}), "SCENE"));
}

}  // namespace dmpc::tests::refusals_test
