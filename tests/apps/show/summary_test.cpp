#include "apps/show/summary.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "tests/apps/show/rendered.h"

namespace dmpc::apps::summary_test {

namespace {

std::string summary(const RenderOptions& options) {
  std::ostringstream output;
  print_summary(output, Rendered(options).record());
  return output.str();
}

}  // namespace

TEST_CASE("the closing lines name scene, computer, memory, rays, pages, times and picture") {
  std::ostringstream output;
  print_summary(output, Rendered(small()).record());
  for (const std::string part :
       {"scene    balls-1, ", "computer 3 nodes, svm, ", "memory   ", "home pages ", "rays     ", "(primary 192, ", "pages    ",
        " look-ups: at home ", "time     load 0.500 s", "picture  ", "16x12"}) {
    CHECK_MESSAGE(contains(output.str(), part), part);
  }
}

TEST_CASE("the closing lines of a pool tell that pages are counted as copies, unless there are some") {
  const auto tells = [](RenderOptions options, std::uint32_t pool_threads) {
    options.computer.pool_threads = pool_threads == 0 ? std::nullopt : std::optional(pool_threads);
    return contains(summary(options), "; pages are counted as copies, but lie in the host's database, ");
  };
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::forest}) {
    CHECK(tells(small(strategy), 2));
    CHECK_FALSE(tells(small(strategy), 0));
    CHECK_FALSE(tells(modelled(strategy), 0));
  }
  CHECK_FALSE(tells(small(Strategy::dataflow), 2));
}

TEST_CASE("the film's hash is found when the closing lines name it, and not before") {
  const Rendered rendered(small());
  const RenderRecord record = rendered.record();
  CHECK_FALSE(record.found_film_hash);
  std::ostringstream output;
  print_summary(output, record);
  CHECK(record.found_film_hash == account_of(*rendered.report).film.hash());
}

TEST_CASE("the closing lines of replicated do without pages") {
  const std::string text = summary(small(Strategy::replicated));
  CHECK_FALSE(contains(text, "pages    "));
  CHECK(contains(text, "computer 3 nodes, replicated, 16 pixels in flight\n"));
}

TEST_CASE("the last closing line says how light got about, and what nobody asked for, with what to say instead") {
  RenderOptions options = small();
  CHECK_FALSE(contains(summary(options), "paths"));
  options.picture.transport = {.kind = core::TransportKind::paths, .bounces = 1, .sky = SkyChoice{{1, 1, 1}, {}}};
  options.picture.depth = options.picture.transport.depth();
  CHECK(contains(summary(options), ", paths, 1 bounce, sky 1,1,1\n"));
  options.picture.is_refined_unasked = true;
  CHECK(contains(summary(options), ", refined to the default error of 1/100 (--samples=1 for one ray a pixel)\n"));
  options.picture.is_by_paths_unasked = true;
  CHECK(contains(summary(options), "sky 1,1,1, refined to the default error of 1/100 (--transport=whitted for hard light)\n"));
  options.picture = small().picture;
  options.picture.is_refined_unasked = true;
  CHECK(contains(summary(options), ", refined to the default error of 1/255 (--samples=1"));
}

TEST_CASE("the closing lines of forest say what was asked") {
  const std::string text = summary(small(Strategy::forest));
  CHECK(contains(text, "computer 3 nodes, forest, forest of 1 page, 16 pixels in flight\n"));
  CHECK(contains(text, "asked    "));
  CHECK(contains(text, " about rays, "));
  CHECK(contains(text, "; all answered\n"));
  CHECK_FALSE(contains(text, "pages    "));
}

TEST_CASE("the closing lines of dataflow say how rays travelled and how evenly the work was shared") {
  const std::string text = summary(small(Strategy::dataflow));
  for (const std::string part :
       {"computer 3 nodes, dataflow, 34 rays a packet, 21 credits a pair, 256 packets queued\n", "rays     ", "(primary 192, ",
        "travel   ", " messages, ", " hops a ray, in ", " % full; overflowed ", "load     predicted ", " %, achieved ",
        " % (mean over maximum of the nodes' work)\n", "regions  ", " copies of a record; on the hypercube ",
        " if mapped at random\n", ", prepare 0.250 s,"}) {
    CHECK_MESSAGE(contains(text, part), part);
  }
  CHECK_FALSE(contains(text, "pages    "));
}

TEST_CASE("the closing lines of a modelled machine tell virtual time and what became of it, apart from the wall clock") {
  for (const Strategy strategy : {Strategy::svm, Strategy::replicated, Strategy::dataflow}) {
    const std::string text = summary(modelled(strategy));
    for (const std::string part : {"virtual  ", " s on ipsc2, ", " events; run_hash ", ", machine_digest ",
                                   "\nlosses   computing ", " %, idle at the end ", " %\ntime     load 0.500 s"}) {
      CHECK_MESSAGE(contains(text, part), part);
    }
    CHECK_FALSE(contains(summary(small(strategy)), "virtual  "));
    CHECK_FALSE(contains(summary(small(strategy)), "losses   "));
  }
  RenderOptions one = modelled();
  one.pages.in_flight = 1;
  CHECK(contains(summary(one), ", page wait "));
  CHECK(contains(summary(modelled(Strategy::dataflow)), ", ray wait "));
}

TEST_CASE("a host that is busy for more than half of a modelled run is told, and no other") {
  RenderOptions options = modelled(Strategy::replicated, "hdr");
  options.computer.node_count = 64;  // on 192 pixels
  CHECK(contains(summary(options), "\nhost     busy for "));
  CHECK_FALSE(contains(summary(modelled(Strategy::replicated)), "host     busy for "));
}

TEST_CASE("memory ports are told") {
  nodes::Machine machine = find_machine_preset("cm5")->machine;
  machine.has_memory_port = true;
  CHECK(contains(summary(on_machine(small(), machine)), " s on cm5 with memory ports, "));
}

TEST_CASE("links that do not contend are told") {
  nodes::Machine machine = find_machine_preset("cm5")->machine;
  machine.has_contention = false;
  CHECK(contains(summary(on_machine(small(), machine)), " s on cm5 without contention, "));
}

TEST_CASE("regions of equal size were predicted no load") {
  RenderOptions options = small(Strategy::dataflow);
  options.rays.balance.balance = dataflow::Balance::equal_size;
  CHECK(contains(summary(options), "load     achieved "));
}

}  // namespace dmpc::apps::summary_test
