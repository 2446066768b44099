#include "apps/render/pass_progress.h"

#include <doctest/doctest.h>

#include <sstream>

namespace dmpc::apps::pass_progress_test {

namespace {

/// A run that asks for an error of 1/255, with a clock that stands still until it is set.
struct Run {
  explicit Run(const RefinedRun& run = {.error = 1.0 / 255}) : passes(progress, run, [this] { return seconds; }) {}

  double seconds = 0;
  std::ostringstream output;
  Progress progress{output, true};
  PassProgress passes;
};

core::PassEnd pass_end(double steps, std::uint64_t done, std::uint64_t chosen) {
  return {.result = {.passes = 1, .error = steps / 255}, .samples_done = done, .samples_chosen = chosen};
}

}  // namespace

TEST_CASE("before an error is known a pass says so, and how much of it is done") {
  Run run;
  run.passes.update(50, 100);
  CHECK(run.passes.label() == "Pass 1 (its error is not known yet):");
  CHECK(run.passes.share() == 0.5);
  CHECK(run.output.str().find("Pass 1 (its error is not known yet): 50 % [") != std::string::npos);
  CHECK(run.output.str().find("/s") == std::string::npos);  // pixels of different passes have no rate
}

TEST_CASE("the time that is left is that of the samples which the error still needs") {
  Run run;
  run.passes.update(100, 100);
  run.seconds = 10;
  CHECK_FALSE(run.passes.ends_before(pass_end(2, 1000, 500)));  // four times as many by the root: 3,000 more at 100 a second
  run.passes.update(0, 50);
  CHECK(run.passes.label() == "Pass 2, error 2.00/255 of 1.00/255, 0:30 left:");
  CHECK(run.passes.share() == doctest::Approx(0.25));
  run.seconds = 15;
  run.passes.update(50, 50);
  CHECK(run.passes.label() == "Pass 2, error 2.00/255 of 1.00/255, 0:25 left:");
  CHECK(run.passes.share() == doctest::Approx(15.0 / 40));
}

TEST_CASE("two passes tell by which power of the number of samples the error falls") {
  Run run;
  run.seconds = 10;
  run.passes.ends_before(pass_end(4, 1000, 1000));
  run.seconds = 20;
  run.passes.ends_before(pass_end(2, 2000, 1000));  // by the number itself: twice as many will do
  run.passes.update(0, 50);
  CHECK(run.passes.label().find("0:20 left") != std::string::npos);
}

TEST_CASE("a pass that is under way is waited for, even if it brings more samples than the error needs") {
  Run run;
  run.seconds = 10;
  run.passes.ends_before(pass_end(1.1, 1000, 4000));
  run.passes.update(0, 50);
  CHECK(run.passes.label().find("0:40 left") != std::string::npos);
}

TEST_CASE("the share never falls") {
  Run run;
  run.seconds = 10;
  run.passes.ends_before(pass_end(2, 1000, 1000));
  run.passes.update(10, 10);
  const double before = run.passes.share();
  run.passes.ends_before(pass_end(1.99, 2000, 1000));  // hardly any better
  run.passes.update(0, 10);
  CHECK(run.passes.share() == before);
}

TEST_CASE("a pass of as many pixels as the last is told by their being fewer again, and a resumed run counts on") {
  Run run({.error = 1.0 / 255, .pass = 3, .samples_done = 1000});
  run.passes.update(10, 10);
  run.seconds = 5;
  run.passes.ends_before(pass_end(2, 1500, 100));  // 100 a second
  run.passes.update(1, 10);
  CHECK(run.passes.label().find("Pass 4,") == 0);
  run.passes.update(10, 10);
  CHECK(run.passes.share() <= 1);
}

TEST_CASE("a picture ends between the two passes that are nearest to its time") {
  const auto ends = [](double seconds_max) {
    Run run({.error = 1.0 / 255, .seconds = seconds_max});
    run.seconds = 10;
    return run.passes.ends_before(pass_end(2, 1000, 1000));  // the next pass would end at 20 seconds
  };
  CHECK(ends(5));
  CHECK(ends(14.9));
  CHECK_FALSE(ends(15.1));
  CHECK_FALSE(ends(30));
}

TEST_CASE("with a time, no more of it is left than it has") {
  Run run({.error = 1.0 / 255, .seconds = 25});
  run.passes.update(10, 10);
  run.seconds = 10;
  run.passes.ends_before(pass_end(4, 1000, 1000));
  run.passes.update(0, 10);
  CHECK(run.passes.label() == "Pass 2, error 4.00/255 of 1.00/255, 0:15 left:");
}

}  // namespace dmpc::apps::pass_progress_test
