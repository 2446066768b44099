#include "apps/frontend/run/work.h"

#include <doctest/doctest.h>

#include <initializer_list>

#include "core/trace/charge.h"

namespace dmpc::apps::run_work_test {

namespace {

using core::Charge;
using nodes::Activity;

nodes::Span charged(std::initializer_list<Charge> charges, Activity activity = Activity::work) {
  nodes::Span span{.activity = activity};
  span.before[Charge::shading] = span.after[Charge::shading] = 3;
  for (const Charge charge : charges) {
    span.after[charge] += 2;
  }
  return span;
}

Doing doing(std::initializer_list<Charge> charges) { return doing_of(charged(charges).charged()); }

Work work(Activity activity, std::initializer_list<Charge> charges) {
  return static_cast<Work>(work_of(charged(charges, activity)));
}

}  // namespace

TEST_CASE("what a call was for follows from what it was charged") {
  CHECK(doing({}) == Doing::other);
  CHECK(doing({Charge::ray_packing}) == Doing::pack);
  CHECK(doing({Charge::page_install}) == Doing::install);
  CHECK(doing({Charge::page_install, Charge::cell_step}) == Doing::trace);
  CHECK(doing({Charge::ray_setup, Charge::ray_packing}) == Doing::trace);
  CHECK(doing({Charge::shading, Charge::cell_step}) == Doing::shade);
  CHECK(doing({Charge::tile_read}) == Doing::shade);
}

TEST_CASE("a span counts as what it was charged for, or as messages or pages of its kind") {
  CHECK(work(Activity::work, {Charge::cell_step}) == Work::tracing);
  CHECK(work(Activity::work, {Charge::shading, Charge::cell_step}) == Work::shading);
  CHECK(work(Activity::receive, {Charge::page_install}) == Work::installing);
  CHECK(work(Activity::receive, {Charge::ray_packing}) == Work::packing);
  CHECK(work(Activity::receive, {}) == Work::overhead);
  CHECK(work(Activity::serve, {}) == Work::service_busy);
  CHECK(work_of({.activity = Activity::serve, .is_in_idle = true, .before = {}, .after = {}}) ==
        static_cast<std::size_t>(Work::service_idle));
  CHECK(work(Activity::send, {}) == Work::messages);
  CHECK(work(Activity::take_over, {}) == Work::messages);
}

}  // namespace dmpc::apps::run_work_test
