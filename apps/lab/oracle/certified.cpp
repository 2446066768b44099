#include "apps/lab/oracle/certified.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/trace/certificate.h"

namespace dmpc::apps {
namespace {

double last_place(float t) { return double{std::nextafter(t, std::numeric_limits<float>::infinity())} - double{t}; }

}  // namespace

CertifiedHit certified(const core::Ray& ray, const core::PrimitiveValues& values, float t) {
  if (values.needs_plane()) {
    return {};  // hit where the plane is that others share or doubles say (core/database/coplanar.h), not its own corners
  }
  const core::Certificate certificate = core::certify(ray, values.kind, values.value.data(), 1, 0);
  if (!certificate.is_decided()) {
    return {};
  }
  const double place = last_place(std::max(t, static_cast<float>(certificate.t.high))),
               off = std::max(double{t} - certificate.t.low, certificate.t.high - double{t});
  return {
      fault_of(ray, values, t, certificate), true,        values.kind != core::PrimitiveKind::triangle || certificate.is_inside(),
      certificate.t.width() / place,         off / place, certificate.t_error / place};
}

double Spread::median() const {
  if (values_.empty()) {
    return 0;
  }
  std::vector<double> values = values_;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double Spread::worst() const { return values_.empty() ? 0 : *std::max_element(values_.begin(), values_.end()); }

void CertifiedCounts::count(const CertifiedHit& hit) {
  ++hits;
  if (!hit.is_decided) {
    ++undecided;
    return;
  }
  ++faults[static_cast<std::size_t>(hit.fault)];
  width_ulp.add(hit.width_ulp);
  if (hit.is_inside) {
    ++inside;
    error_ulp.add(hit.error_ulp);
    allowed_ulp.add(hit.allowed_ulp);
  }
}

std::uint64_t CertifiedCounts::failures() const {
  return std::accumulate(faults.begin(), faults.end(), std::uint64_t{0}) -
         faults[static_cast<std::size_t>(CertificateFault::none)];
}

}  // namespace dmpc::apps
