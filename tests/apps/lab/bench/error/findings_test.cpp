#include "apps/lab/bench/error/findings.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/frontend/table/plot_data.h"
#include "apps/lab/bench/error/table.h"
#include "tests/support/text.h"

namespace dmpc::tests::findings_test {

using apps::Knob;
using apps::Measurement;
using apps::SceneResult;

namespace {

constexpr double step = 1.0 / 255;

/// A picture whose error is the same in all groups of pixels.
Measurement measured(std::uint64_t rays, double error) {
  return {.seconds = {static_cast<double>(rays)},
          .rays = rays,
          .samples = rays,
          .squares = std::vector<double>(apps::pixel_groups, error * error / apps::pixel_groups)};
}

/// The same error, but all of it in every other group: its square has a deviation of 1 / sqrt(63).
Measurement uneven(Measurement one) {
  for (std::size_t group = 0; group < apps::pixel_groups; ++group) {
    one.squares[group] *= group % 2 == 0 ? 2 : 0;
  }
  return one;
}

/// `asked` is the error asked of adaptive sampling.
void add(SceneResult& result, Knob knob, const std::string& text, const Measurement& one, double asked = 0) {
  apps::Setting setting{.error = asked};
  setting.samples = knob == Knob::samples ? std::stoi(text) : 2;
  result.measurement_of.push_back(result.measurements.size());
  result.points.push_back({knob, text, setting});
  result.measurements.push_back(one);
}

/// Uniform sampling with errors of 32, 8 and 4 8-bit steps, which fall with time^-1/2, and adaptive sampling, which was asked for
/// 16 and 8 and takes `share` of that time.
SceneResult scene_result(double share, double own_error = 0) {
  SceneResult result{.scene = "tetra-2", .width = 2, .height = 2};
  result.reference.own_error = own_error;
  for (const int samples : {1, 16, 64}) {
    add(result, Knob::samples, std::to_string(samples),
        measured(100U * static_cast<unsigned>(samples), 32 * step / std::sqrt(samples)));
  }
  for (const int samples : {1, 4, 20, 100}) {
    add(result, Knob::adaptive,
        samples == 4    ? "16/255"
        : samples == 20 ? "8/255"
                        : "far from what it is",
        measured(static_cast<std::uint64_t>(share * 100 * samples), 32 * step / std::sqrt(samples)),
        samples == 4    ? 16 * step
        : samples == 20 ? 8 * step
                        : 100);
  }
  return result;
}

/// Changes the measured points of one knob.
template <class Change>
SceneResult changed(SceneResult result, Knob knob, const Change& change) {
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    if (result.points[point].knob == knob) {
      change(result.measurements[result.measurement_of[point]]);
    }
  }
  return result;
}
void make_uneven(Measurement& one) { one = uneven(one); }

/// Deterministic errors of cutoffs: less error, more rays.
void add_cutoffs(SceneResult& result) {
  for (const auto& [text, rays, error] : {std::tuple{"1/64", 60U, 1.0 / 1000}, {"1/255", 80U, 1.0 / 2000}, {"0", 100U, 0.0}}) {
    Measurement one = measured(rays, 0.1);
    one.deterministic.emplace().root_mean_square = error;
    one.setting = error == 0 ? result.base : one.setting;
    add(result, Knob::cutoff, text, one);
  }
}

std::size_t column(const apps::Table& table, const std::string& name) {
  const auto found = std::ranges::find(table.columns(), name, &apps::Column::name);
  REQUIRE(found != table.columns().end());
  return static_cast<std::size_t>(found - table.columns().begin());
}

}  // namespace

TEST_CASE("what chance costs in place of aiming is said in time for the same error, as a bound where one sample errs less") {
  SceneResult result = scene_result(0.25);
  result.base.bounces = 2;
  result.emitters = 3;
  add(result, Knob::emitters, "none", measured(2000, 16 * step));  // as four samples, which take 400
  add(result, Knob::roulette, "never", measured(3000, 8 * step));  // as 16
  CHECK(contains(apps::findings_of(result).back(), "BSDF sampling alone takes 5.00 times the time"));
  CHECK(contains(apps::findings_of(result).back(), "no roulette takes 1.88 times the time"));
  result.measurements[result.measurements.size() - 2] = measured(2000, 96 * step);
  CHECK(contains(apps::findings_of(result).back(), "BSDF sampling alone takes at least 20.00 times the time"));
}

TEST_CASE("adaptive sampling's share of uniform sampling's time is told at each error that it was asked for and both reach") {
  const auto shares = apps::adaptive_shares(scene_result(0.25));
  REQUIRE(shares.size() == 2);
  CHECK(shares[0].error == "16/255");
  for (const apps::AdaptiveShare& share : shares) {
    CHECK(share.time.middle == doctest::Approx(0.25));
    CHECK(share.time.low == doctest::Approx(0.25));
    CHECK(share.time.high == doctest::Approx(0.25));
    CHECK(share.rays == doctest::Approx(0.25));
  }
  CHECK(apps::findings_of(scene_result(0.25)).front() ==
        "tetra-2: adaptive takes 0.25 of uniform's time at 16/255 (0.25 to 0.25), 0.25 at 8/255 (0.25 to 0.25); in rays 0.25 at "
        "16/255, "
        "0.25 at 8/255.");
}

TEST_CASE("a share's interval has what pixels differ in, but for what both pictures have in common") {
  const double factor = std::exp(2 / std::sqrt(63));
  const SceneResult one = changed(scene_result(1.1), Knob::adaptive, make_uneven);
  const apps::AdaptiveShare share = apps::adaptive_shares(one).front();
  CHECK(share.time.middle == doctest::Approx(1.1));
  CHECK(share.time.low == doctest::Approx(1.1 / factor).epsilon(0.001));
  CHECK(share.time.high == doctest::Approx(1.1 * factor).epsilon(0.001));
  CHECK(contains(apps::findings_of(one).front(),
                 "tetra-2: between adaptive and uniform no difference that this run can tell at 16/255 (0.85 to 1.42), 8/255"));
  const SceneResult both = changed(one, Knob::samples, make_uneven);
  CHECK(apps::adaptive_shares(both).front().time.high == doctest::Approx(1.1));
}

TEST_CASE("a share's interval has what rounds differ in, and its middle the least times") {
  const auto add_round = [](Measurement& one) { one.seconds.push_back(one.seconds.front() * 1.5); };
  const SceneResult slow = changed(scene_result(0.5), Knob::adaptive, add_round);
  const SceneResult result = changed(slow, Knob::samples, [](Measurement& one) { one.seconds.push_back(one.seconds.front()); });
  const apps::Estimate time = apps::adaptive_shares(result).front().time;
  CHECK(time.middle == doctest::Approx(0.5));
  CHECK(time.high == doctest::Approx(0.75));
}

TEST_CASE("without an error that both reach there is no share, which is said if both were measured") {
  CHECK(apps::adaptive_shares({}).empty());
  CHECK(apps::text_of(std::span<const apps::AdaptiveShare>()).empty());
  SceneResult result{.scene = "tetra-2"};
  add(result, Knob::samples, "1", measured(1, 0.5));
  CHECK_FALSE(contains(apps::findings_of(result).front(), "adaptive"));
  add(result, Knob::adaptive, "1/2", measured(1, 0.5), 0.5);
  CHECK(apps::adaptive_shares(result).front().is_undecided());
  add(result, Knob::adaptive, "1/4", measured(4, 0.25), 0.25);
  result.points[1].setting.error = 1;
  CHECK(apps::adaptive_shares(result).empty());
  CHECK(contains(apps::findings_of(result).front(), "no error asked of adaptive sampling is reached by both"));
}

TEST_CASE("the reference's own error is taken off in squares, as the product of the distances from its halves") {
  apps::Reference reference{.picture = apps::Image(2, 1), .difference = apps::Image(2, 1)};
  apps::Image picture(2, 1);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    picture.rgb[channel] = 1;
    reference.picture.rgb[channel] = 0.75F;
    reference.difference.rgb[channel] = 0.125F;  // from halves of 0.875 and 0.625
  }
  const Measurement one{.squares = apps::square_errors(picture, reference)};
  CHECK(one.squares.size() == apps::pixel_groups);
  CHECK(apps::error_of(one) == doctest::Approx(std::sqrt(0.125 * 0.375 / 2)));
  const Measurement none{.squares = apps::square_errors(reference.picture, reference)};
  CHECK(apps::error_of(none) == 0);
  CHECK_FALSE(apps::is_told({}, none));
}

TEST_CASE("an error is told from the reference's own one on") {
  SceneResult result;
  result.reference.own_error = 5;
  CHECK_FALSE(apps::is_told(result, measured(1, 4.99)));
  CHECK(apps::is_told(result, measured(1, 5.01)));
  CHECK_FALSE(apps::is_told(result, {}));
}

TEST_CASE("an error's interval follows from how much groups of pixels differ") {
  CHECK(apps::error_interval(measured(1, 3)).low == doctest::Approx(3));
  CHECK(apps::error_interval(measured(1, 3)).high == doctest::Approx(3));
  const apps::Estimate estimate = apps::error_interval(uneven(measured(1, 3)));
  CHECK(estimate.low == doctest::Approx(3 * std::exp(-1 / std::sqrt(63))));
  CHECK(estimate.middle == doctest::Approx(3));
  CHECK(estimate.high == doctest::Approx(3 * std::exp(1 / std::sqrt(63))));
  CHECK(apps::error_of(uneven(measured(1, 3)), 0) == doctest::Approx(3 * std::sqrt(62.0 / 63)));
}

TEST_CASE("the cheapest cutoff has a deterministic error below a quarter of an 8-bit step") {
  SceneResult result = scene_result(0.5);
  CHECK_FALSE(apps::cheapest_point(result, Knob::cutoff));
  add_cutoffs(result);
  const auto cheapest = apps::cheapest_point(result, Knob::cutoff);
  REQUIRE(cheapest);
  CHECK(result.points[*cheapest].text == "1/255");
  CHECK(contains(apps::findings_of(result).back(), "cutoff 1/255 (0.128/255, 0.800 times the rays)"));
}

TEST_CASE("a table of errors has the rows that are measured, and no error below the reference's own") {
  SceneResult result = scene_result(0.25, 3.5 * step);
  add(result, Knob::adaptive, "late", {});
  const apps::Table table = apps::table_of(std::vector{result}, "errors");
  REQUIRE(table.rows().size() == 7);
  const auto text = [&](std::size_t row, const char* name) {
    return std::get<std::string>(table.rows()[row][column(table, name)]);
  };
  CHECK(std::get<double>(table.rows()[0][column(table, "error")]) == doctest::Approx(32));
  CHECK(text(0, "remark").empty());
  CHECK(std::get_if<double>(&table.rows()[6][column(table, "error")]) == nullptr);
  CHECK(text(6, "remark") == "less than the reference's own error");
  std::string front;
  for (std::size_t row = 0; row < 7; ++row) {
    front += text(row, "front") == "yes" ? "1" : "0";
  }
  CHECK(front == "0011110");  // the best uniform samples are beaten only by what is not told
}

TEST_CASE("the first picture has uniform and adaptive sampling alone, and their front, the second one all knobs") {
  SceneResult result = scene_result(0.25);
  CHECK(apps::plots_of(result, "error").size() == 1);
  add(result, Knob::depth, "3", measured(10, step));  // beats all
  const apps::Table table = apps::table_of(std::vector{result}, "errors");
  const auto yes = [&](const char* name, std::size_t row) {
    return std::get<std::string>(table.rows()[row][column(table, name)]) == "yes";
  };
  CHECK(yes("front", 7));
  CHECK_FALSE(yes("front", 6));
  CHECK(yes("front of uniform and adaptive", 6));
  CHECK_FALSE(yes("front of uniform and adaptive", 7));
  const auto plots = apps::plots_of(result, "error");
  REQUIRE(plots.size() == 2);
  CHECK(plots[1].name == apps::knobs_plot_of("error"));
  const std::string first = *apps::plot_data(plots[0], table), second = *apps::plot_data(plots[1], table);
  CHECK(contains(first, "tetra-2: adaptive takes 0.25 of uniform's time at 8/255 (0.25 to 0.25)"));
  CHECK(contains(first, R"("mark":"intervals")"));
  CHECK_FALSE(contains(first, R"("name":"depth")"));
  CHECK(contains(second, R"("name":"depth")"));
}

TEST_CASE("the first words say what adaptive sampling takes, and where errors end") {
  const std::string words = apps::summary_of(std::vector{scene_result(0.25, 3.5 * step)});
  CHECK(contains(words, "tetra-2: adaptive takes 0.25"));
  CHECK(contains(words, "errors end at its own one, 3.500/255 (relative MSE 0): of 1 setting below it"));
  CHECK(apps::summary_of({}).empty());
}

}  // namespace dmpc::tests::findings_test
