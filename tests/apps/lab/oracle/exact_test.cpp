#include "apps/lab/oracle/exact.h"

#include <doctest/doctest.h>

#include <cmath>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/targets.h"
#include "core/trace/primitive.h"
#include "tests/apps/lab/oracle/primitives.h"

namespace dmpc::tests::exact_test {
namespace {

using apps::CertificateFault;
using core::Certificate;
using core::Interval;
using core::PrimitiveValues;
using core::Ray;
using core::Vec3d;

const PrimitiveValues facing = triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1});

Certificate certificate_of(const Ray& ray, const PrimitiveValues& values) {
  return core::certify(ray, values.kind, values.value.data(), 1, 0);
}
float hit_of(const Ray& ray, const PrimitiveValues& values) {
  return values.kind == core::PrimitiveKind::triangle ? core::intersect_triangle(core::ShearedRay(ray), values.value.data(), 1, 0)
                                                      : core::intersect_sphere(ray, values.value.data(), 1, 0);
}
/// `t` some units in its last place farther.
float moved(float t, int places) {
  for (; places > 0; --places) {
    t = std::nextafter(t, 1e30F);
  }
  return t;
}

TEST_CASE("a certificate holds for its hit, and fails as it says for any other") {
  const Ray at = ray({0.25F, 0.5F, 0}, {0, 0, 1});
  const float t = hit_of(at, facing);
  const Certificate good = certificate_of(at, facing);
  CHECK(apps::fault_of(at, facing, t, good) == CertificateFault::none);
  CHECK(apps::fault_of(at, facing, moved(t, 16), good) == CertificateFault::hit);
  Certificate bad = good;
  bad.t = Interval(1 + 1e-15, 2);
  CHECK(apps::fault_of(at, facing, t, bad) == CertificateFault::distance);
  bad = good;
  bad.v = Interval(0, 0.5 - 1e-16);
  CHECK(apps::fault_of(at, facing, t, bad) == CertificateFault::weights);
}

TEST_CASE("a hit that is claimed farther outside an edge than floats may take it fails") {
  const Ray beside = ray({-1e-5F, 0.5F, 0}, {0, 0, 1});
  CHECK(hit_of(beside, facing) < 0);
  CHECK(apps::fault_of(beside, facing, 1, certificate_of(beside, facing)) == CertificateFault::edge);
}

TEST_CASE("floats that hit an edge may be as far outside as the rest of their origin") {
  Ray on_edge = ray({0, 0.5F, 0}, {0, 0, 1});
  on_edge.origin_rest.x = -0x1p-27F;
  REQUIRE(hit_of(on_edge, facing) == 1);
  Certificate certificate = certificate_of(on_edge, facing);
  CHECK(apps::fault_of(on_edge, facing, 1, certificate) == CertificateFault::none);
  certificate.edge_error = {0, 0, 0};
  CHECK(apps::fault_of(on_edge, facing, 1, certificate) == CertificateFault::edge);
}

TEST_CASE("who claims an answer that does not exist is found out") {
  Certificate claim;
  claim.t = claim.u = claim.v = Interval(0, 1);
  CHECK(apps::fault_of(ray({0, 0, 0}, {1, 0, 0}), facing, 1, claim) == CertificateFault::no_answer);
  CHECK(apps::fault_of(ray({0, 0, 0}, {1, 0, 0}), facing, 1, {}) == CertificateFault::none);
  CHECK(apps::fault_of(ray({3, 0, 0}, {0, 0, 1}), sphere({0, 0, 9}, 1), 1, claim) == CertificateFault::no_answer);
}

TEST_CASE("a sphere's certificate names the root that counts") {
  const PrimitiveValues ball = sphere({0, 0, 3}, 1);
  const Ray through = ray({0, 0, 0}, {0, 0, 1});
  Certificate certificate = certificate_of(through, ball);
  CHECK(apps::fault_of(through, ball, 2, certificate) == CertificateFault::none);
  CHECK(apps::fault_of(through, ball, moved(2, 1), certificate) == CertificateFault::hit);
  certificate.t = Interval(4 - 1e-9, 4 + 1e-9);
  CHECK(apps::fault_of(through, ball, 4, certificate) == CertificateFault::distance);
}

TEST_CASE("a cone's certificate names the first root that counts") {
  const PrimitiveValues pipe = cone({0, 0, 3}, 1, {0, 0, 4}, 1);
  const Ray across = ray({0, -3, 3.5F}, {0, 1, 0});
  Certificate certificate = certificate_of(across, pipe);
  CHECK(apps::fault_of(across, pipe, 2, certificate) == CertificateFault::none);
  CHECK(apps::fault_of(across, pipe, moved(2, 1), certificate) == CertificateFault::hit);
  certificate.t = Interval(4 - 1e-9, 4 + 1e-9);
  CHECK(apps::fault_of(across, pipe, 4, certificate) == CertificateFault::distance);
  CHECK(apps::fault_of(ray({0, 0, 0}, {0, 0.25F, 1}), pipe, 4, certificate) == CertificateFault::none);  // on the rim itself
  CHECK(apps::fault_of(ray({0, 0, 0}, {0, 0.2490234375F, 1}), pipe, 4, certificate) == CertificateFault::distance);
}

/// A triangle down to 1e-3 of the scene, down to a sliver a millionth as wide as long, hit from somewhere.
struct Meeting {
  explicit Meeting(apps::Random& random) {
    const Vec3d a = random.in_box(0, 1), along = random.in_box(-1, 1) * std::pow(10.0, random.between(-3, 0));
    const Vec3d c = a + along * random.unit() + random.in_box(-1, 1) * (length(along) * std::pow(10.0, random.between(-6, 0)));
    values = triangle(core::Vec3f(a), core::Vec3f(a + along), core::Vec3f(c));
    at.start_at(random.in_box(-1, 2));
    const Vec3d target = apps::target_of(values, random.below(apps::targets_per_triangle)) + random.in_box(-1, 1) * 1e-8;
    at.go_along(normalize(target - at.full_origin()));
    t = hit_of(at, values);
  }

  PrimitiveValues values;
  Ray at;
  float t = 0;
};

TEST_CASE("no certificate of a random hit fails, and with a third of its bound of t or a quarter of its edges' some do") {
  apps::Random random(5);
  int hits = 0, failures = 0, hit_failures = 0, edge_failures = 0;
  while (hits < 5000) {
    const Meeting met(random);
    if (!(met.t > 0)) {
      continue;
    }
    ++hits;
    Certificate certificate = certificate_of(met.at, met.values);
    failures += apps::fault_of(met.at, met.values, met.t, certificate) != CertificateFault::none ? 1 : 0;
    const double t_error = certificate.t_error;
    certificate.t_error = t_error / 3;
    hit_failures += apps::fault_of(met.at, met.values, met.t, certificate) == CertificateFault::hit ? 1 : 0;
    certificate.t_error = t_error;
    for (double& error : certificate.edge_error) {
      error /= 4;
    }
    edge_failures += apps::fault_of(met.at, met.values, met.t, certificate) == CertificateFault::edge ? 1 : 0;
  }
  CHECK(failures == 0);
  CHECK(hit_failures > 0);
  CHECK(edge_failures > 0);
}

TEST_CASE("of a face in a tilted plane that it shares nothing is certified, of one in a level plane all") {
  const Ray at = ray({0.25F, 0.5F, 0}, {0, 0, 1});
  PrimitiveValues face = facing;
  face.lie_in(PrimitiveValues::level_plane);
  CHECK(apps::certified(at, face, 1).is_decided);
  face.lie_in(1);
  CHECK_FALSE(apps::certified(at, face, 1).is_decided);
}

TEST_CASE("counts of certified hits keep medians and worst") {
  apps::CertifiedCounts counts;
  counts.count({CertificateFault::none, true, true, 1, 2, 3});
  counts.count({CertificateFault::edge, true, false, 3, 4, 5});
  counts.count({CertificateFault::none, true, true, 2, 9, 9});
  counts.count({});
  CHECK(counts.hits == 4);
  CHECK(counts.undecided == 1);
  CHECK(counts.inside == 2);
  CHECK(counts.failures() == 1);
  CHECK(counts.width_ulp.median() == 2);
  CHECK(counts.error_ulp.worst() == 9);
  CHECK(counts.allowed_ulp.median() == 9);  // the greater of two
  CHECK(apps::Spread().median() == 0);
}

}  // namespace
}  // namespace dmpc::tests::exact_test
