#include "apps/render/pass_progress.h"

#include <doctest/doctest.h>

#include <sstream>

namespace dmpc::apps::pass_progress_test {

TEST_CASE("a pass says its number, and that all before it are done") {
  std::ostringstream output;
  Progress progress(output, true);
  PassProgress passes(progress, 1, 4);
  passes.update(50, 100);
  CHECK(passes.label() == "Pass 1 of at most 4:");
  CHECK(passes.share() == 0.125);
  passes.update(100, 100);
  CHECK(passes.share() == 0.25);
  passes.update(0, 10);
  CHECK(passes.label() == "Pass 2 of at most 4:");
  CHECK(passes.share() == 0.25);
  passes.update(5, 10);
  CHECK(passes.share() == 0.375);
  CHECK(output.str().find("Pass 1 of at most 4: 12 % [") != std::string::npos);
  CHECK(output.str().find("/s") == std::string::npos);  // pixels of different passes have no rate
}

TEST_CASE("a pass of as many pixels as the last is told by their being fewer again") {
  std::ostringstream output;
  Progress progress(output, false);
  PassProgress passes(progress, 3, 4);
  passes.update(10, 10);
  passes.update(1, 10);
  CHECK(passes.label() == "Pass 4 of at most 4:");
  passes.update(10, 10);
  CHECK(passes.share() == 1);
}

}  // namespace dmpc::apps::pass_progress_test
