#include "apps/lab/bench/error/findings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps {
namespace {

constexpr double quarter_step = 0.25 / 255;

using CostOf = std::function<double(const Measurement&)>;

double rays_of(const Measurement& measurement) { return static_cast<double>(measurement.rays); }
double seconds_of(const Measurement& measurement) { return measurement.least_seconds(); }

/// Returns the curve of one knob, without a group of pixels if `left_out` is one.
std::vector<CostPoint> curve_of(const SceneResult& result, Knob knob, const CostOf& cost, std::size_t left_out = pixel_groups) {
  std::vector<CostPoint> curve;
  for (std::size_t point = 0; point < result.points.size(); ++point) {
    if (result.points[point].knob == knob && is_told(result, result.of(point))) {
      curve.push_back({cost(result.of(point)), error_of(result.of(point), left_out)});
    }
  }
  return curve;
}

std::optional<double> share_at(const SceneResult& result, double error, const CostOf& cost, std::size_t left_out = pixel_groups) {
  const auto uniform = cost_at(curve_of(result, Knob::samples, cost, left_out), error);
  const auto adaptive = cost_at(curve_of(result, Knob::adaptive, cost, left_out), error);
  return uniform && adaptive ? std::optional(*adaptive / *uniform) : std::nullopt;
}

std::optional<Estimate> time_share_at(const SceneResult& result, double error) {
  const std::optional<double> middle = share_at(result, error, seconds_of);
  double variance = 0, spread = 0;
  for (std::size_t group = 0; middle && group < pixel_groups; ++group) {
    const double other = share_at(result, error, seconds_of, group).value_or(*middle);
    variance += std::pow(std::log(other / *middle), 2) * (pixel_groups - 1) / pixel_groups;
  }
  for (std::size_t round = 0; middle && round < result.measurements.front().seconds.size(); ++round) {
    const auto seconds = [round](const Measurement& one) { return one.seconds[std::min(round, one.seconds.size() - 1)]; };
    const std::optional<double> other = share_at(result, error, seconds);
    spread = std::max(spread, std::abs(std::log(other.value_or(*middle) / *middle)));
  }
  const double factor = std::exp(std::hypot(2 * std::sqrt(variance), spread));
  return middle ? std::optional(Estimate{*middle / factor, *middle, *middle * factor}) : std::nullopt;
}

bool has(const SceneResult& result, Knob knob) {
  return std::ranges::find(result.points, knob, &Point::knob) != result.points.end();
}

std::string adaptive_text(const SceneResult& result) {
  const std::vector<AdaptiveShare> shares = adaptive_shares(result);
  std::string rays;
  for (const AdaptiveShare& share : shares) {
    rays += (rays.empty() ? "; in rays " : ", ") + fixed(share.rays, 2) + " at " + share.error;
  }
  if (!shares.empty()) {
    return result.scene + ": " + text_of(shares) + rays + ".";
  }
  return has(result, Knob::samples) && has(result, Knob::adaptive)
             ? result.scene + ": no error asked of adaptive sampling is reached by both it and uniform sampling."
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

/// Returns "0.9/255", with a mark if the reference cannot tell it.
std::string error_text(const SceneResult& result, const Measurement& measurement) {
  return fixed(255 * error_of(measurement), 2) + "/255" +
         (is_told(result, measurement) ? "" : " (below the reference's own error)");
}

std::string quality_text(const SceneResult& result) {
  const Measurement* const draft = measured(result, Knob::quality, "draft");
  const Measurement* const good = measured(result, Knob::quality, "good");
  if (draft == nullptr || good == nullptr) {
    return "";
  }
  const double rays = static_cast<double>(draft->rays) / static_cast<double>(std::max<std::uint64_t>(good->rays, 1));
  return result.scene + ": good quality has an error of " + error_text(result, *good) + ", draft " + error_text(result, *draft) +
         " for " + fixed(rays, 3) + " times the rays (" + fixed(draft->least_seconds() / good->least_seconds(), 3) +
         " times the seconds).";
}

/// A point's time as a multiple of that of uniform samples with the same error: `at_least` if one sample has less error.
struct ChanceRatio {
  double seconds = 0;
  bool at_least = false;
};
std::optional<ChanceRatio> chance_ratio(const SceneResult& result, Knob knob, const std::string& position) {
  const Measurement* const turned = measured(result, knob, position);
  const std::vector<CostPoint> even = curve_of(result, Knob::samples, seconds_of);
  if (turned == nullptr || !is_told(result, *turned) || even.empty()) {
    return std::nullopt;
  }
  const double error = error_of(*turned), seconds = turned->least_seconds();
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

/// The reference, and where it ends the range of errors.
std::string reference_text(const SceneResult& result) {
  const std::string n = std::to_string(result.reference_samples_a_side);
  const auto below = static_cast<std::uint64_t>(
      std::ranges::count_if(result.measurements, [&](const Measurement& one) { return one.is_done() && !is_told(result, one); }));
  return result.scene + ": the reference has " + n + "x" + n + " samples a pixel, " +
         (result.base.is_by_paths() ? counted(static_cast<std::uint64_t>(*result.base.bounces), "bounce")
                                    : "depth " + std::to_string(result.base.depth)) +
         ", " + grouped(result.reference.rays) + " rays in " + seconds_text(result.reference.seconds) +
         "; errors end at its own one, " + fixed(255 * result.reference.own_error, 3) + "/255 (relative MSE " +
         scientific(result.reference.own_relative_mean_square) + ")" +
         (below == 0 ? "."
                     : ": of " + counted(below, "setting") +
                           " below it nothing is drawn or compared; a larger --reference-samples reaches further.");
}

}  // namespace

std::vector<AdaptiveShare> adaptive_shares(const SceneResult& result) {
  std::vector<AdaptiveShare> shares;
  for (const Point& point : result.points) {
    const double error = point.setting.error;
    if (const auto time = point.knob == Knob::adaptive ? time_share_at(result, error) : std::nullopt) {
      shares.push_back({point.text, *time, share_at(result, error, rays_of).value_or(0)});
    }
  }
  return shares;
}

std::string text_of(std::span<const AdaptiveShare> shares) {
  std::string decided, undecided;
  for (const AdaptiveShare& share : shares) {
    const std::string at = share.error + " (" + fixed(share.time.low, 2) + " to " + fixed(share.time.high, 2) + ")";
    if (share.is_undecided()) {
      undecided += (undecided.empty() ? "no difference that this run can tell at " : ", ") + at;
    } else {
      const std::string times = fixed(share.time.middle, 2);
      decided += decided.empty() ? "adaptive takes " + times + " of uniform's time at " + at : ", " + times + " at " + at;
    }
  }
  return decided + (undecided.empty() ? "" : (decided.empty() ? "between adaptive and uniform " : "; ") + undecided);
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
       {adaptive_text(result), reference_text(result), cheapest_text(result), quality_text(result), chance_text(result)}) {
    if (!text.empty()) {
      sentences.push_back(std::move(text));
    }
  }
  return sentences;
}

std::string summary_of(std::span<const SceneResult> results) {
  std::string summary;
  for (const SceneResult& result : results) {
    if (std::ranges::any_of(result.measurements, &Measurement::is_done)) {
      const std::string adaptive = adaptive_text(result);
      summary += (summary.empty() ? "" : " ") + adaptive + (adaptive.empty() ? "" : " ") + reference_text(result);
    }
  }
  return summary;
}

}  // namespace dmpc::apps
