#include "apps/lab/bench/error/findings.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/lab/bench/error/table.h"
#include "tests/support/text.h"

namespace dmpc::tests::findings_test {

using apps::Knob;
using apps::Measurement;
using apps::SceneResult;

namespace {

Measurement measured(std::uint64_t rays, double error) {
  Measurement one{.seconds = {static_cast<double>(rays)}, .rays = rays, .samples = rays};
  one.error.root_mean_square = error;
  return one;
}

void add(SceneResult& result, Knob knob, const std::string& text, const Measurement& one) {
  apps::Setting setting;
  setting.samples = knob == Knob::samples ? std::stoi(text) : 2;
  result.measurement_of.push_back(result.measurements.size());
  result.points.push_back({knob, text, setting});
  result.measurements.push_back(one);
}

/// Uniform sampling whose error falls with rays^-1/2, and refinement that takes `share` of its rays.
SceneResult scene_result(double share, double own_error = 0) {
  SceneResult result{.scene = "tetra-2", .width = 2, .height = 2};
  result.reference.own_error = own_error;
  for (const int samples : {1, 16, 64}) {
    add(result, Knob::samples, std::to_string(samples), measured(100U * static_cast<unsigned>(samples), 1 / std::sqrt(samples)));
  }
  for (const int samples : {1, 4, 20, 100}) {
    add(result, Knob::adaptive, std::to_string(samples),
        measured(static_cast<std::uint64_t>(share * 100 * samples), 1 / std::sqrt(samples)));
  }
  return result;
}

/// Deterministic errors of cutoffs: less error, more rays.
void add_cutoffs(SceneResult& result) {
  for (const auto& [text, rays, error] : {std::tuple{"1/64", 60U, 1.0 / 1000}, {"1/255", 80U, 1.0 / 2000}, {"0", 100U, 0.0}}) {
    Measurement one = measured(rays, 0.1);
    one.deterministic.emplace().root_mean_square = error;
    one.setting = error == 0 ? result.base : one.setting;
    add(result, Knob::cutoff, text, one);
  }
}

}  // namespace

TEST_CASE("what chance costs in place of aiming is said in time for the same error, as a bound where one sample errs less") {
  SceneResult result = scene_result(0.25);
  result.base.bounces = 2;
  result.emitters = 3;
  add(result, Knob::emitters, "none", measured(2000, 0.5));    // as four samples, which take 400
  add(result, Knob::roulette, "never", measured(3000, 0.25));  // as 16
  CHECK(contains(apps::findings_of(result).back(), "BSDF sampling alone takes 5.00 times the time"));
  CHECK(contains(apps::findings_of(result).back(), "no roulette takes 1.88 times the time"));
  result.measurements[result.measurements.size() - 2].error.root_mean_square = 3;
  CHECK(contains(apps::findings_of(result).back(), "BSDF sampling alone takes at least 20.00 times the time"));
}

TEST_CASE("what adaptive sampling is worth in time stands first, at an error of one 8-bit step") {
  SceneResult result = scene_result(0.25);
  CHECK_FALSE(apps::adaptive_gain(result).seconds);  // no error is so small
  for (Measurement& one : result.measurements) {
    one.error.root_mean_square /= 50;
  }
  REQUIRE(apps::adaptive_gain(result).rays);
  CHECK(*apps::adaptive_gain(result).rays == doctest::Approx(4));
  CHECK(contains(apps::findings_of(result).front(), "for an RMSE of 1/255 uniform samples take "));
}

TEST_CASE("the reference's own error is taken off in squares") {
  SceneResult result;
  result.reference.own_error = 3;
  CHECK_FALSE(apps::error_without_reference(result, measured(1, 6)));
  result.reference.own_error = 5;
  CHECK(*apps::error_without_reference(result, measured(1, 13)) == doctest::Approx(12));
  CHECK_FALSE(apps::is_claimed(result, measured(1, 49.9)));
  CHECK(apps::is_claimed(result, measured(1, 50)));
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

TEST_CASE("a table of errors has the rows that are measured and marks fronts and what is not claimed") {
  SceneResult result = scene_result(0.25, 0.03);
  add(result, Knob::adaptive, "late", {});
  const apps::Table table = apps::table_of(std::vector{result}, "errors");
  REQUIRE(table.rows().size() == 7);
  const auto cell = [&](std::size_t row, std::size_t column) { return std::get<std::string>(table.rows()[row][column]); };
  const std::size_t remark = 15, front = 16;
  CHECK(cell(0, remark).empty());
  CHECK(cell(0, front).empty());
  CHECK(cell(2, remark) == "less than 10 times the reference's own");
  CHECK(cell(3, front) == "yes");
  CHECK(cell(5, front).empty());
}

TEST_CASE("what is less than 10 times the reference's own is drawn hollow, by what is left of it and between what") {
  const SceneResult result = scene_result(0.25, 0.03);
  const apps::Table table = apps::plotted_table(result);
  REQUIRE(table.rows().size() == 7);
  const auto column = [&](const std::string& name) {
    const auto found =
        std::find_if(table.columns().begin(), table.columns().end(), [&](const auto& one) { return one.name == name; });
    return static_cast<std::size_t>(found - table.columns().begin());
  };
  const auto number = [&](std::size_t row, const char* name) { return std::get_if<double>(&table.rows()[row][column(name)]); };
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    const bool is_claimed = apps::is_claimed(result, result.of(row));
    CHECK((number(row, "drawn RMSE") != nullptr) == is_claimed);
    CHECK((number(row, "most without") == nullptr) == is_claimed);
  }
  CHECK(*number(2, "least without") <= *number(2, "RMSE without the reference's"));
  CHECK(*number(2, "RMSE without the reference's") <= *number(2, "most without"));
  const auto plots = apps::plots_of(result, "error");
  CHECK(contains(*apps::script_of(plots[0], table, "error.csv"), "with yerrorbars pointtype 6"));
}

TEST_CASE("an interval ends where the reference's own error is taken off twice, and at a tenth at least") {
  SceneResult result;
  result.reference.own_error = 3;
  const apps::ErrorInterval far = apps::error_interval(result, measured(1, 10));
  CHECK(far.low == doctest::Approx(8));
  CHECK(far.middle == doctest::Approx(std::sqrt(91.0)));
  CHECK(far.high == 10);
  CHECK(apps::error_interval(result, measured(1, 2)).low == doctest::Approx(0.2));
  CHECK(apps::error_interval(result, measured(1, 2)).middle == doctest::Approx(0.2));
}

TEST_CASE("the first words say what adaptive sampling is worth and how many settings are told from the reference") {
  CHECK(contains(apps::summary_of(std::vector{scene_result(0.25, 0.03)}), " of 7 settings have errors of at least 10 times"));
  CHECK(apps::summary_of({}).empty());
}

}  // namespace dmpc::tests::findings_test
