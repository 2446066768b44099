// The difference at which two pictures count as different: --fail-above.
#pragma once

#include <string>
#include <vector>

#include "apps/lab/difference/picture_error.h"

namespace dmpc::apps {

struct Measure {
  const char* name;  ///< its name in --fail-above
  double (*of)(const PictureError& error);
};

struct Limit {
  const Measure* measure = nullptr;
  double most = 0;
  std::string text;  ///< as typed: "1/255"
};

/// Returns "rmse|max|...", for help.
std::string measure_names();

/// Parses "rmse:1/255": a measure, a colon and a number from 0 on. Throws core::UsageError for anything else.
Limit parse_limit(const std::string& text);

/// Returns why the pictures count as different, one sentence for each exceeded limit: "rmse 0.25 is above 1/255". Infinity and
/// NaN are above any limit.
std::vector<std::string> passed_limits(const std::vector<Limit>& limits, const PictureError& error);

}  // namespace dmpc::apps
