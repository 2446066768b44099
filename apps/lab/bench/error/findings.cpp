#include "apps/lab/bench/error/findings.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/table/averages.h"
#include "apps/lab/bench/error/result.h"

namespace dmpc::apps {
namespace {

constexpr double step = 1.0 / 255, quarter_step = step / 4;

/// The curve of one knob, with both costs.
struct Curve {
  std::vector<CostPoint> rays, seconds;
};

Curve curve_of(const SceneResult& result, Knob knob) {
  Curve curve;
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    const Measurement& measurement = result.of(point);
    const auto error = measurement.is_done() ? error_without_reference(result, measurement) : std::nullopt;
    if (result.points[point].knob == knob && error) {
      curve.rays.push_back({static_cast<double>(measurement.rays), *error});
      curve.seconds.push_back({median(measurement.seconds), *error});
    }
  }
  return curve;
}

std::optional<double> divided(std::optional<double> cost, double whole) {
  return cost && whole > 0 ? std::optional(*cost / whole) : std::nullopt;
}

std::string gain_text(const SceneResult& result) {
  const AdaptiveGain gain = adaptive_gain(result);
  return gain.seconds && gain.rays ? result.scene + ": for an RMSE of 1/255 uniform samples take " + fixed(*gain.seconds, 2) +
                                         " times the time of adaptive ones (" + fixed(*gain.rays, 2) + " times the rays)."
                                   : "";
}

/// "1/255 (0.123/255, 0.81 times the rays)".
std::string point_text(const SceneResult& result, std::size_t point) {
  const auto exact = std::find_if(result.measurements.begin(), result.measurements.end(),
                                  [&](const Measurement& one) { return one.setting == result.base; });
  const double error = 255 * result.of(point).deterministic->root_mean_square;
  const double share = static_cast<double>(result.of(point).rays) / static_cast<double>(std::max<std::uint64_t>(exact->rays, 1));
  return result.points[point].text + " (" + fixed(error, 3) + "/255, " + fixed(share, 3) + " times the rays)";
}

std::string cheapest_text(const SceneResult& result) {
  std::string text;
  for (const Knob knob : {Knob::cutoff, Knob::depth}) {
    if (const auto point = cheapest_point(result, knob)) {
      text += (text.empty() ? "" : ", ") + std::string(name_of(knob)) + " " + point_text(result, *point);
    }
  }
  return text.empty() ? ""
                      : result.scene + ": cheapest with a deterministic RMSE below a quarter of an 8-bit step: " + text + ".";
}

const Measurement* measured(const SceneResult& result, Knob knob, const std::string& position) {
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    if (result.points[point].knob == knob && result.points[point].text == position && result.of(point).is_done()) {
      return &result.of(point);
    }
  }
  return nullptr;
}

/// Returns "0.9/255", with a mark if it is not claimed.
std::string error_text(const SceneResult& result, const Measurement& measurement) {
  return fixed(255 * measurement.error.root_mean_square, 2) + "/255" +
         (is_claimed(result, measurement) ? "" : " (less than 10 times the reference's own error)");
}

std::string quality_text(const SceneResult& result) {
  const Measurement *const draft = measured(result, Knob::quality, "draft"), *const standard =
                                                                                 measured(result, Knob::quality, "default");
  if (draft == nullptr || standard == nullptr) {
    return "";
  }
  const double rays = static_cast<double>(draft->rays) / static_cast<double>(std::max<std::uint64_t>(standard->rays, 1));
  return result.scene + ": default quality has an RMSE of " + error_text(result, *standard) + ", draft " +
         error_text(result, *draft) + " for " + fixed(rays, 3) + " times the rays (" +
         fixed(median(draft->seconds) / median(standard->seconds), 3) + " times the seconds).";
}

/// A point's time as a multiple of that of uniform samples with the same error: `at_least` if one sample has less error.
struct ChanceRatio {
  double seconds = 0;
  bool at_least = false;
};
std::optional<ChanceRatio> chance_ratio(const SceneResult& result, Knob knob, const std::string& position) {
  const Measurement* const turned = measured(result, knob, position);
  const double error = turned != nullptr ? error_without_reference(result, *turned).value_or(0) : 0;
  const std::vector<CostPoint> even = curve_of(result, Knob::samples).seconds;
  if (!(error > 0) || even.empty()) {
    return std::nullopt;
  }
  const double seconds = median(turned->seconds);
  if (const auto cost = cost_at(even, error)) {
    return ChanceRatio{seconds / *cost};
  }
  const CostPoint worst = std::ranges::max(even, {}, &CostPoint::error);
  return error > worst.error && worst.cost > 0 ? std::optional(ChanceRatio{seconds / worst.cost, true}) : std::nullopt;
}

/// "BSDF sampling alone takes 3.21 times the time for the same RMSE; no roulette takes ...".
std::string chance_text(const SceneResult& result) {
  if (!result.base.is_by_paths()) {
    return "";
  }
  std::string text;
  const auto add = [&](const std::string& what, const std::optional<ChanceRatio>& ratio) {
    if (ratio) {
      text += (text.empty() ? "" : "; ") + what + " takes " + (ratio->at_least ? "at least " : "") + fixed(ratio->seconds, 2) +
              " times the time for the same RMSE";
    }
  };
  add("BSDF sampling alone", chance_ratio(result, Knob::emitters, "none"));
  add("no roulette", chance_ratio(result, Knob::roulette, "never"));
  const bool has_none = result.emitters == 0;
  return (text.empty() ? "" : result.scene + ": " + text + "." + (has_none ? " " : "")) +
         (has_none ? result.scene + ": there is no emitter for light sampling; --light-radius turns lights into spheres." : "");
}

std::string scientific(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

std::string reference_text(const SceneResult& result) {
  const std::string n = std::to_string(result.reference_samples_a_side);
  return result.scene + ": the reference has " + n + "x" + n + " samples a pixel, " +
         (result.base.is_by_paths() ? counted(static_cast<std::uint64_t>(*result.base.bounces), "bounce")
                                    : "depth " + std::to_string(result.base.depth)) +
         ", " + grouped(result.reference.rays) + " rays in " + seconds_text(result.reference.seconds) + "; its own error is " +
         fixed(255 * result.reference.own_error, 4) + "/255 (relative MSE " +
         scientific(result.reference.own_relative_mean_square) + ").";
}

}  // namespace

AdaptiveGain adaptive_gain(const SceneResult& result) {
  const Curve even = curve_of(result, Knob::samples), adaptive = curve_of(result, Knob::adaptive);
  const auto gain = [](std::span<const CostPoint> of_even, std::span<const CostPoint> of_adaptive) {
    return divided(cost_at(of_even, step), cost_at(of_adaptive, step).value_or(0));
  };
  return {.seconds = gain(even.seconds, adaptive.seconds), .rays = gain(even.rays, adaptive.rays)};
}

std::optional<std::size_t> cheapest_point(const SceneResult& result, Knob knob) {
  std::optional<std::size_t> cheapest;
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    const auto& error = result.of(point).deterministic;
    const bool is_good = result.points[point].knob == knob && error && error->root_mean_square < quarter_step;
    if (is_good && (!cheapest || result.of(point).rays < result.of(*cheapest).rays)) {
      cheapest = point;
    }
  }
  return cheapest;
}

std::vector<std::string> findings_of(const SceneResult& result) {
  std::vector<std::string> sentences;
  for (std::string text :
       {gain_text(result), reference_text(result), cheapest_text(result), quality_text(result), chance_text(result)}) {
    if (!text.empty()) {
      sentences.push_back(std::move(text));
    }
  }
  return sentences;
}

std::string summary_of(std::span<const SceneResult> results) {
  std::uint64_t all = 0, claimed = 0;
  std::string gains;
  for (const SceneResult& result : results) {
    for (std::size_t point = 0; point < result.points.size(); ++point) {
      all += result.of(point).is_done() ? 1 : 0;
      claimed += result.of(point).is_done() && is_claimed(result, result.of(point)) ? 1 : 0;
    }
    const std::string gain = gain_text(result);
    gains += gain.empty() ? "" : gain + " ";
  }
  return all == 0 ? ""
                  : gains + grouped(claimed) + " of " + counted(all, "setting") +
                        " have errors of at least 10 times the reference's own" +
                        (claimed == all ? "."
                                        : "; of the others the reference's is taken off in squares, and plots show them hollow, "
                                          "with an interval.");
}

}  // namespace dmpc::apps
