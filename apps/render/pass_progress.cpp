#include "apps/render/pass_progress.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps {

namespace {

/// Between these powers errors fall: slower where rare events are found late, faster where few pixels have all of the error.
constexpr double power_min = 0.25, power_max = 2;

double power_between(const core::PassEnd& before, const core::PassEnd& after) {
  const double more = std::log(static_cast<double>(after.samples_done) / static_cast<double>(before.samples_done));
  return std::clamp(std::log(before.result.error / after.result.error) / more, power_min, power_max);
}

std::string error_text(double error) { return fixed(255 * error, 2) + "/255"; }

}  // namespace

PassProgress::PassProgress(Progress& progress, const RefinedRun& run, std::function<double()> seconds)
    : progress_(progress), run_(run), seconds_(std::move(seconds)), pass_(run.pass) {}

std::string PassProgress::label() const {
  const std::string error =
      end_ ? ", error " + error_text(end_->result.error) + " of " + error_text(run_.error) : " (its error is not known yet)";
  return "Pass " + std::to_string(pass_) + error + (seconds_left_ ? ", " + clock_text(*seconds_left_) + " left" : "") + ":";
}

/// From the samples done so far, in the share of the pass that has arrived.
void PassProgress::estimate() {
  const double of_pass = static_cast<double>(done_) / total_;
  if (!end_) {
    share_ = of_pass;
    return;
  }
  const auto before = static_cast<double>(end_->samples_done);
  const double done = before + static_cast<double>(end_->samples_chosen) * of_pass;
  const double needed = before * std::pow(end_->result.error / run_.error, 1 / power_);
  const double seconds = seconds_(), rate = (done - static_cast<double>(run_.samples_done)) / std::max(seconds, 1e-9);
  double left = std::max(needed - done, static_cast<double>(end_->samples_chosen) * (1 - of_pass)) / rate;
  left = run_.seconds ? std::min(left, std::max(*run_.seconds - seconds, 0.0)) : left;
  seconds_left_ = left;
  share_ = std::max(share_, seconds / (seconds + left));
}

void PassProgress::update(std::uint32_t done, std::uint32_t total) {
  pass_ += total_ != 0 && (done < done_ || total != total_) ? 1 : 0;
  done_ = done;
  total_ = total;
  estimate();
  constexpr std::uint64_t steps = 1'000'000;
  progress_.show(label(), static_cast<std::uint64_t>(share_ * steps), steps);
}

bool PassProgress::ends_before(const core::PassEnd& end) {
  power_ = end_ ? power_between(*end_, end) : power_;
  share_ = end_ ? share_ : 0;
  end_ = end;
  if (!run_.seconds) {
    return false;
  }
  const double seconds = seconds_();
  const double next =
      seconds * static_cast<double>(end.samples_chosen) / static_cast<double>(end.samples_done - run_.samples_done);
  return seconds + next / 2 > *run_.seconds;
}

}  // namespace dmpc::apps
